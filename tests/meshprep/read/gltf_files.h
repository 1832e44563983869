// glTF files for tests: an editable document, and the bytes of its buffer.
#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <nlohmann/json.hpp>

#include "meshprep/mesh.h"

namespace malus::prep::test {

inline std::string littleEndian32(std::uint32_t value) {
  std::string bytes;
  for (int i = 0; i < 4; ++i) bytes += static_cast<char>(value >> (8 * i) & 0xffu);
  return bytes;
}

// RFC 4648, the slow way.
inline std::string base64(std::string_view bytes) {
  constexpr std::string_view kLetters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8 | (i + j < bytes.size() ? static_cast<unsigned char>(bytes[i + j]) : 0u);
    for (std::size_t j = 0; j < 4; ++j) text += i + j > bytes.size() ? '=' : kLetters[group >> (18 - 6 * j) & 63u];
  }
  return text;
}

struct GltfFile {
  nlohmann::json document = {{"asset", {{"version", "2.0"}}}};
  std::string bin;

  template <class Number>
  static std::string toBytes(const std::vector<Number>& numbers) {
    std::string bytes(numbers.size() * sizeof(Number), '\0');
    std::memcpy(bytes.data(), numbers.data(), bytes.size());
    return bytes;
  }

  // All return the index of the added object.
  int add(const char* list, nlohmann::json object) {
    document[list].push_back(std::move(object));
    return static_cast<int>(document[list].size()) - 1;
  }
  int addView(std::string_view bytes) {
    bin.resize((bin.size() + 3) / 4 * 4, '\0');
    const std::size_t offset = bin.size();
    bin += bytes;
    return add("bufferViews", {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes.size()}});
  }
  int addAccessor(int view, int componentType, std::size_t count, const char* type) {
    return add("accessors", {{"bufferView", view}, {"componentType", componentType}, {"count", count}, {"type", type}});
  }
  int addVectors(const std::vector<glm::vec3>& values) {
    return addAccessor(addView(toBytes(values)), 5126, values.size(), "VEC3");
  }
  template <class Index>
  int addIndices(const std::vector<Index>& values) {
    constexpr int kType = sizeof(Index) == 1 ? 5121 : sizeof(Index) == 2 ? 5123 : 5125;
    return addAccessor(addView(toBytes(values)), kType, values.size(), "SCALAR");
  }
  int addMesh(const Mesh& mesh, const char* name, int material = -1) {
    std::vector<glm::vec3> positions;
    for (const glm::dvec3& p : mesh.positions) positions.emplace_back(p);
    std::vector<std::uint16_t> indices;
    for (const glm::uvec3& t : mesh.triangles)
      for (const std::uint32_t i : {t.x, t.y, t.z}) indices.push_back(static_cast<std::uint16_t>(i));
    nlohmann::json primitive = {{"attributes", {{"POSITION", addVectors(positions)}}},
                                {"indices", addIndices(indices)}};
    if (material >= 0) primitive["material"] = material;
    return add("meshes", {{"name", name}, {"primitives", {primitive}}});
  }
  // A root of scene 0.
  int addNode(nlohmann::json node) {
    const int index = add("nodes", std::move(node));
    if (!document.contains("scenes")) document["scenes"] = {{{"nodes", nlohmann::json::array()}}};
    document["scenes"][0]["nodes"].push_back(index);
    return index;
  }

  std::string glb() const {
    nlohmann::json whole = document;
    if (!bin.empty() && !whole.contains("buffers")) whole["buffers"] = {{{"byteLength", bin.size()}}};
    std::string json = whole.dump(), data = bin;
    json.resize((json.size() + 3) / 4 * 4, ' ');
    data.resize((data.size() + 3) / 4 * 4, '\0');
    std::string chunks = littleEndian32(static_cast<std::uint32_t>(json.size())) + "JSON" + json;
    if (!data.empty())
      chunks += littleEndian32(static_cast<std::uint32_t>(data.size())) + std::string("BIN\0", 4) + data;
    return "glTF" + littleEndian32(2) + littleEndian32(static_cast<std::uint32_t>(12 + chunks.size())) + chunks;
  }
  // JSON with its buffer at `uri`, or in a data URI if that is empty.
  std::string gltf(const std::string& uri = {}) const {
    nlohmann::json whole = document;
    if (!bin.empty() && !whole.contains("buffers"))
      whole["buffers"] = {{{"byteLength", bin.size()},
                           {"uri", uri.empty() ? "data:application/octet-stream;base64," + base64(bin) : uri}}};
    return whole.dump();
  }
};

// One triangle at the node `node`, ready to be spoilt.
inline GltfFile triangleFile(nlohmann::json node = nlohmann::json::object()) {
  GltfFile file;
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}};
  file.addMesh(mesh, "triangle");
  node["mesh"] = 0;
  file.addNode(node);
  return file;
}

}  // namespace malus::prep::test
