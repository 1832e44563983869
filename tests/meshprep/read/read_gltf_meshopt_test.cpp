// Buffer views with EXT_meshopt_compression, encoded by meshoptimizer.
#include <cstdint>

#include <meshoptimizer.h>
#include <glm/geometric.hpp>

#include "meshprep/read/read_gltf.h"
#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::errorIn;
using test::GltfFile;
using test::readGlb;

std::string encodeVertices(const void* data, std::size_t count, std::size_t stride) {
  std::string bytes(meshopt_encodeVertexBufferBound(count, stride), 0);
  bytes.resize(
      meshopt_encodeVertexBuffer(reinterpret_cast<unsigned char*>(bytes.data()), bytes.size(), data, count, stride));
  return bytes;
}

// A view of `count` elements whose bytes are compressed in the buffer.
int addCompressedView(GltfFile& gltf, const std::string& bytes, std::size_t count, std::size_t stride, const char* mode,
                      const char* filter = "NONE") {
  const int raw = gltf.addView(bytes);
  json& view = gltf.document["bufferViews"][static_cast<std::size_t>(raw)];
  const json offset = view["byteOffset"];
  view = {{"buffer", 1},
          {"byteLength", count * stride},
          {"extensions",
           {{"EXT_meshopt_compression",
             {{"buffer", 0},
              {"byteOffset", offset},
              {"byteLength", bytes.size()},
              {"byteStride", stride},
              {"count", count},
              {"mode", mode},
              {"filter", filter}}}}}};
  if (*mode == 'A') view["byteStride"] = stride;
  return raw;
}

// A quad of two triangles with normals, all compressed.
GltfFile compressedFile(bool sequence = false) {
  GltfFile gltf;
  const std::vector<glm::vec3> positions = {{0, 0, 0}, {1, 0, 0}, {1, 2, 0}, {0, 2, 0}};
  const std::vector<std::uint32_t> corners = {0, 1, 2, 0, 2, 3};
  const int position = gltf.addAccessor(addCompressedView(gltf, encodeVertices(positions.data(), 4, sizeof(glm::vec3)),
                                                          4, sizeof(glm::vec3), "ATTRIBUTES"),
                                        5126, 4, "VEC3");
  std::string indices(sequence ? meshopt_encodeIndexSequenceBound(6, 4) : meshopt_encodeIndexBufferBound(6, 4), 0);
  auto* const out = reinterpret_cast<unsigned char*>(indices.data());
  indices.resize(sequence ? meshopt_encodeIndexSequence(out, indices.size(), corners.data(), 6)
                          : meshopt_encodeIndexBuffer(out, indices.size(), corners.data(), 6));
  const int index =
      gltf.addAccessor(addCompressedView(gltf, indices, 6, 2, sequence ? "INDICES" : "TRIANGLES"), 5123, 6, "SCALAR");
  std::vector<float> normals;
  for (int i = 0; i < 4; ++i) normals.insert(normals.end(), {0, 0.6f, 0.8f, 0});
  std::vector<std::int8_t> octahedral(16);
  meshopt_encodeFilterOct(octahedral.data(), 4, 4, 8, normals.data());
  const int normal = gltf.addAccessor(
      addCompressedView(gltf, encodeVertices(octahedral.data(), 4, 4), 4, 4, "ATTRIBUTES", "OCTAHEDRAL"), 5120, 4,
      "VEC3");
  gltf.document["accessors"][static_cast<std::size_t>(normal)]["normalized"] = true;
  gltf.add("meshes",
           {{"primitives", {{{"attributes", {{"POSITION", position}, {"NORMAL", normal}}}, {"indices", index}}}}});
  gltf.addNode({{"mesh", 0}});
  gltf.document["extensionsUsed"] = {"EXT_meshopt_compression", "KHR_mesh_quantization"};
  gltf.document["extensionsRequired"] = gltf.document["extensionsUsed"];
  gltf.document["buffers"] = {
      {{"byteLength", gltf.bin.size()}},
      {{"byteLength", 4 * 12 + 12 + 16}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  return gltf;
}

TEST(GltfMeshopt, AttributesTrianglesAndFilters) {
  for (const bool sequence : {false, true}) {
    const SourceScene scene = readGlb(compressedFile(sequence));
    const Polygons& quad = scene.parts[0].polygons;
    ASSERT_EQ(quad.faceCount(), 2u);
    double area = 0;
    for (std::size_t f = 0; f < 2; ++f) {
      const auto corner = [&](std::size_t i) { return quad.positions[quad.corners[3 * f + i]]; };
      area += 0.5 * glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z;
    }
    EXPECT_DOUBLE_EQ(area, 2);
    for (const glm::vec3& n : quad.normals) EXPECT_LT(glm::distance(n, glm::vec3(0, 0.6f, 0.8f)), 0.02f);
    EXPECT_TRUE(scene.notes.empty());
  }
}

TEST(GltfMeshopt, WrongDataIsAnError) {
  const auto error = [](const char* key, const json& value, std::size_t view = 0) {
    GltfFile gltf = compressedFile();
    gltf.document["bufferViews"][view]["extensions"]["EXT_meshopt_compression"][key] = value;
    return errorIn(gltf);
  };
  EXPECT_CONTAINS(error("mode", "POINTS"), "bufferViews[0].extensions", "unknown mode", "'POINTS'");
  EXPECT_CONTAINS(error("mode", "TRIANGLES"), "stride", "2 or 4");
  EXPECT_CONTAINS(error("filter", "SHARPEN"), "unknown filter");
  EXPECT_CONTAINS(error("filter", "QUATERNION"), "stride", "QUATERNION");
  EXPECT_CONTAINS(error("byteStride", 0), "invalid stride");
  EXPECT_CONTAINS(error("byteStride", 260), "invalid stride");
  EXPECT_CONTAINS(error("count", 1'000'000'000), "too many elements");
  EXPECT_CONTAINS(error("count", 5, 1), "multiple of 3");
  EXPECT_CONTAINS(error("byteLength", 5), "corrupt");
  EXPECT_CONTAINS(error("byteLength", 1'000'000), "exceeds its buffer");
  EXPECT_CONTAINS(error("buffer", 9), "buffers[9]");
  EXPECT_CONTAINS(error("count", 3), "elements exceed the buffer view");
  // Every changed byte is read or refused.
  const GltfFile gltf = compressedFile();
  for (std::size_t i = 0; i < gltf.bin.size(); ++i) {
    GltfFile changed = gltf;
    changed.bin[i] = static_cast<char>(changed.bin[i] ^ 0x55);
    errorIn(changed);
  }
}

}  // namespace
}  // namespace malus::prep
