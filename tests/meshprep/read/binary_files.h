// Binary PLY and STL files, byte by byte.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace malus::prep::test {

inline void putInteger(std::string& bytes, std::uint64_t value, std::size_t size, bool bigEndian = false) {
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * (bigEndian ? size - 1 - i : i) & 0xff);
}

inline void putReal(std::string& bytes, double value, bool isDouble, bool bigEndian = false) {
  if (isDouble) {
    putInteger(bytes, std::bit_cast<std::uint64_t>(value), 8, bigEndian);
  } else {
    putInteger(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), 4, bigEndian);
  }
}

struct PlyOptions {
  bool bigEndian = false;
  bool doubles = false;
  std::string countType = "uchar";  // uchar or int
  std::string indexType = "int";
  std::size_t indexBytes = 4;
  std::string moreVertexProperties = {};  // lines
  std::size_t moreVertexBytes = 0;
  std::string moreFaceProperties = {};
  std::size_t moreFaceBytes = 0;
  std::string lineEnd = "\n";
};

// A tetrahedron: 4 vertices, 4 faces.
inline std::string binaryPly(const PlyOptions& options = {}) {
  const std::string real = options.doubles ? "double" : "float";
  std::string header = fmt::format(
      "ply\nformat binary_{}_endian 1.0\ncomment a tetrahedron\nelement vertex 4\n"
      "property {} x\nproperty {} y\nproperty {} z\n{}element face 4\nproperty list {} {} "
      "vertex_indices\n{}end_header\n",
      options.bigEndian ? "big" : "little", real, real, real, options.moreVertexProperties, options.countType,
      options.indexType, options.moreFaceProperties);
  std::string bytes;
  for (const char c : header) bytes += c == '\n' ? options.lineEnd : std::string(1, c);
  for (const std::array<double, 3>& p :
       {std::array{0.0, 0.0, 0.0}, std::array{1.0, 0.0, 0.0}, std::array{0.0, 1.0, 0.0}, std::array{0.0, 0.0, 0.1}}) {
    for (const double x : p) putReal(bytes, x, options.doubles, options.bigEndian);
    bytes.append(options.moreVertexBytes, '\7');
  }
  for (const std::array<unsigned, 3>& t :
       {std::array{0u, 2u, 1u}, std::array{0u, 1u, 3u}, std::array{1u, 2u, 3u}, std::array{2u, 0u, 3u}}) {
    putInteger(bytes, 3, options.countType == "int" ? 4 : 1, options.bigEndian);
    for (const unsigned index : t) putInteger(bytes, index, options.indexBytes, options.bigEndian);
    bytes.append(options.moreFaceBytes, '\7');
  }
  return bytes;
}

// Triangles of three corners each.
inline std::string binaryStl(const std::vector<std::array<float, 9>>& triangles, std::string_view title = "") {
  std::string bytes(title);
  bytes.resize(80, ' ');
  putInteger(bytes, triangles.size(), 4);
  for (const std::array<float, 9>& t : triangles) {
    for (int i = 0; i < 3; ++i) putReal(bytes, 0, false);
    for (const float x : t) putReal(bytes, static_cast<double>(x), false);
    putInteger(bytes, 0, 2);
  }
  return bytes;
}

inline std::vector<std::array<float, 9>> tetrahedronTriangles() {
  return {{0, 0, 0, 0, 1, 0, 1, 0, 0},
          {0, 0, 0, 1, 0, 0, 0, 0, 0.1f},
          {1, 0, 0, 0, 1, 0, 0, 0, 0.1f},
          {0, 1, 0, 0, 0, 0, 0, 0, 0.1f}};
}

}  // namespace malus::prep::test
