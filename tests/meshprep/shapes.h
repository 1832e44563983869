// Meshes and files for the tests.
#pragma once

#include <unistd.h>

#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <glm/geometric.hpp>

#include "meshprep/base/error.h"
#include "meshprep/mesh.h"
#include "tests/messages.h"

namespace malus::prep::test {

// Returns a new path with this extension.
inline std::filesystem::path temporaryPath(std::string_view extension) {
  static std::atomic<int> counter{0};
  return std::filesystem::path(testing::TempDir()) /
         fmt::format("malus-meshprep-{}-{}{}", ::getpid(), counter++, extension);
}

// File that is removed by the destructor.
class TemporaryFile {
 public:
  TemporaryFile(std::string_view extension, std::string_view text) : path_(temporaryPath(extension)) {
    std::ofstream file(path_, std::ios::binary);  // writeFile would flush to disk
    file.write(text.data(), static_cast<std::streamsize>(text.size()));
    if (!file.flush()) throw Error(path_.string(), "cannot write");
  }
  ~TemporaryFile() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

using malus::test::contains;
using malus::test::errorMessage;

// Cube from shift to shift + size, with 8 vertices and 12 triangles, outward.
inline Mesh cube(double size = 1, const glm::dvec3& shift = glm::dvec3(0)) {
  Mesh mesh;
  for (int i = 0; i < 8; ++i) mesh.positions.push_back(shift + size * glm::dvec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  mesh.triangles = {{0, 2, 3}, {0, 3, 1}, {4, 5, 7}, {4, 7, 6}, {0, 1, 5}, {0, 5, 4},
                    {2, 6, 7}, {2, 7, 3}, {0, 4, 6}, {0, 6, 2}, {1, 3, 7}, {1, 7, 5}};
  return mesh;
}

// Sphere of radius 1 with two poles and `rings` rings of `columns` vertices, outward.
inline Mesh sphere(std::uint32_t rings, std::uint32_t columns) {
  constexpr double kPi = 3.14159265358979323846;
  Mesh mesh;
  mesh.positions.emplace_back(0, 0, 1);
  for (std::uint32_t r = 1; r <= rings; ++r)
    for (std::uint32_t c = 0; c < columns; ++c) {
      const double theta = kPi * r / (rings + 1), phi = 2 * kPi * c / columns;
      mesh.positions.emplace_back(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta));
    }
  mesh.positions.emplace_back(0, 0, -1);
  const auto at = [&](std::uint32_t r, std::uint32_t c) { return 1 + (r - 1) * columns + c % columns; };
  const auto last = static_cast<std::uint32_t>(mesh.positions.size() - 1);
  for (std::uint32_t c = 0; c < columns; ++c) {
    mesh.triangles.emplace_back(0, at(1, c), at(1, c + 1));
    for (std::uint32_t r = 1; r < rings; ++r) {
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c), at(r + 1, c + 1));
      mesh.triangles.emplace_back(at(r, c), at(r + 1, c + 1), at(r, c + 1));
    }
    mesh.triangles.emplace_back(at(rings, c), last, at(rings, c + 1));
  }
  return mesh;
}

// Both meshes in one.
inline Mesh joined(Mesh a, const Mesh& b) {
  const auto offset = static_cast<std::uint32_t>(a.positions.size());
  a.positions.insert(a.positions.end(), b.positions.begin(), b.positions.end());
  for (const glm::uvec3& t : b.triangles) a.triangles.push_back(t + offset);
  return a;
}

inline Mesh flipped(Mesh mesh) {
  for (glm::uvec3& t : mesh.triangles) t = {t.x, t.z, t.y};
  return mesh;
}

inline std::string objText(const Mesh& mesh) {
  std::string text;
  for (const glm::dvec3& p : mesh.positions) text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
  for (const glm::uvec3& t : mesh.triangles) text += fmt::format("f {} {} {}\n", t.x + 1, t.y + 1, t.z + 1);
  return text;
}

}  // namespace malus::prep::test
