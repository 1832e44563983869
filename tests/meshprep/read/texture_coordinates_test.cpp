// Texture coordinates and tangents of OBJ and glTF, per corner, from the upper left corner of the image.
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <limits>

#include <glm/geometric.hpp>

#include "meshprep/read/read_gltf.h"
#include "meshprep/read/read_mesh.h"
#include "meshprep/read/source_scene.h"
#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::contains;
using test::GltfFile;
using test::hasNote;
using test::TemporaryFile;
using test::triangleFile;

using Coordinates = std::vector<glm::vec2>;

const std::string kTriangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

Polygons readObj(const std::string& text, bool strict = false) {
  const TemporaryFile file(".obj", text);
  return readMesh(file.path(), strict);
}

TEST(ObjTextureCoordinates, EveryFormOfCorners) {
  const std::string vt = "vt 0 0\nvt 0.25 1 7\nvt 0.5\nvn 0 0 1\n";
  const Coordinates expected = {{0, 1}, {0.25f, 0}, {0.5f, 1}};  // v grows upward in OBJ
  EXPECT_EQ(readObj(kTriangle + vt + "f 1/1 2/2 3/3\n").textureCoordinates[0], expected);
  EXPECT_EQ(readObj(kTriangle + vt + "f 1/1/1 2/2/1 3/3/1\n").textureCoordinates[0], expected);
  EXPECT_EQ(readObj(kTriangle + vt + "f 1/-3 2/-2 3/-1\n").textureCoordinates[0], expected);
  EXPECT_EQ(readObj(kTriangle + "f 1/1 2/2 3/3\n" + vt).textureCoordinates[0], expected);  // after the face
  EXPECT_FALSE(readObj(kTriangle + vt + "f 1//1 2//1 3//1\n").hasTextureAttributes());
  EXPECT_FALSE(readObj(kTriangle + vt + "f 1 2 3\n").hasTextureAttributes());
}

TEST(ObjTextureCoordinates, CornersWithoutAreZero) {
  const Polygons polygons = readObj(kTriangle + "vt 0.5 0.25\nf 1 2 3\nf 1/1 2 3//\nf 3 2 1\n");
  EXPECT_EQ(polygons.textureCoordinates[0],
            (Coordinates{{0, 0}, {0, 0}, {0, 0}, {0.5f, 0.75f}, {0, 0}, {0, 0}, {0, 0}, {0, 0}, {0, 0}}));
  EXPECT_EQ(std::count(polygons.notes.begin(), polygons.notes.end(), kMissingCoordinatesNote), 1);
}

TEST(ObjTextureCoordinates, InvalidOnesAreLeftOut) {
  for (const char* bad : {"vt nan 0", "vt 0 inf", "vt 2e6 0", "vt x", "vt", "vt 0 0 0 0"}) {
    const std::string text = kTriangle + bad + "\nvt 1 0\nf 1/1 2/2 3/2\n";
    const Polygons polygons = readObj(text);
    EXPECT_EQ(polygons.textureCoordinates[0], (Coordinates{{0, 0}, {1, 1}, {1, 1}})) << bad;
    EXPECT_TRUE(contains(polygons.notes.back(), "invalid texture coordinates: 1", ":4:")) << polygons.notes.back();
    EXPECT_CONTAINS(test::errorMessage([&] { readObj(text, true); }), ":4:");
  }
  // Invalid faces take their corners with them.
  EXPECT_EQ(readObj(kTriangle + "vt 1 0\nvt 0 0\nf 1/2 2/2 9/2\nf 1/1 2/1 3/1\n").textureCoordinates[0],
            (Coordinates{{1, 1}, {1, 1}, {1, 1}}));
}

// Two faces of two materials, of which one has an image.
TEST(ObjTextureCoordinates, OnlyMaterialsWithAnImageKeepThem) {
  const std::filesystem::path folder = test::temporaryPath("");
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "a.mtl") << "newmtl plain\nKd 1 0 0\nnewmtl wood\nmap_Kd wood.png\n";
  const auto read = [&](const char* second, KeepTextures textures) {
    std::ofstream(folder / "a.obj") << "mtllib a.mtl\n"
                                    << kTriangle << "vt 0.5 0\nusemtl wood\nf 1/1 2/1 3/1\nusemtl " << second
                                    << "\nf 3/1 2/1 1/1\n";
    return readSourceScene(folder / "a.obj", false, false, textures);
  };
  SourceScene scene = read("plain", KeepTextures::needed);
  ASSERT_EQ(scene.parts.size(), 2u);
  EXPECT_EQ(scene.parts[0].polygons.textureCoordinates[0], Coordinates(3, {0.5f, 1}));
  EXPECT_FALSE(scene.parts[1].polygons.hasTextureAttributes());
  EXPECT_TRUE(hasNote(scene, kTextureCoordinatesNote));
  scene = read("wood", KeepTextures::needed);
  EXPECT_FALSE(hasNote(scene, kTextureCoordinatesNote));
  EXPECT_FALSE(read("wood", KeepTextures::none).parts[0].polygons.hasTextureAttributes());
  EXPECT_TRUE(read("plain", KeepTextures::all).parts[1].polygons.hasTextureAttributes());
  std::filesystem::remove_all(folder);
}

json& attributes(GltfFile& gltf) { return gltf.document["meshes"][0]["primitives"][0]["attributes"]; }

template <class Number>
int addValues(GltfFile& gltf, const std::vector<Number>& values, int componentType, const char* type,
              bool normalized = false) {
  const int components = std::string_view(type) == "VEC2" ? 2 : std::string_view(type) == "VEC3" ? 3 : 4;
  const int accessor =
      gltf.addAccessor(gltf.addView(GltfFile::toBytes(values)), componentType, values.size() / components, type);
  if (normalized) gltf.document["accessors"][static_cast<std::size_t>(accessor)]["normalized"] = true;
  return accessor;
}

SourceScene readAll(const GltfFile& gltf, bool strict = false) {
  const TemporaryFile file(".glb", gltf.glb());
  return readGltf(file.path(), strict, false, KeepTextures::all);
}
Polygons readPart(const GltfFile& gltf) { return readAll(gltf).parts.at(0).polygons; }

TEST(GltfTextureCoordinates, EveryType) {
  const Coordinates expected = {{0, 0}, {1, 0}, {0, 1}};
  GltfFile gltf = triangleFile();
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2");
  attributes(gltf)["TEXCOORD_1"] = addValues(gltf, std::vector<float>{0.5f, -3, 1, 8, 0, 0.25f}, 5126, "VEC2");
  const Polygons polygons = readPart(gltf);
  EXPECT_EQ(polygons.textureCoordinates[0], expected);
  EXPECT_EQ(polygons.textureCoordinates[1], (Coordinates{{0.5f, -3}, {1, 8}, {0, 0.25f}}));
  EXPECT_TRUE(polygons.tangents.empty());
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<std::uint8_t>{0, 0, 255, 0, 0, 255}, 5121, "VEC2", true);
  EXPECT_EQ(readPart(gltf).textureCoordinates[0], expected);
  attributes(gltf)["TEXCOORD_0"] =
      addValues(gltf, std::vector<std::uint16_t>{0, 0, 65535, 0, 0, 65535}, 5123, "VEC2", true);
  EXPECT_EQ(readPart(gltf).textureCoordinates[0], expected);

  // Integers that are not normalized, or have signs, need KHR_mesh_quantization.
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<std::int16_t>{0, 0, 1, 0, 0, 1}, 5122, "VEC2");
  EXPECT_TRUE(contains(test::errorMessage([&] { readAll(gltf); }), "wrong type"));
  gltf.document["extensionsUsed"] = {"KHR_mesh_quantization"};
  EXPECT_EQ(readPart(gltf).textureCoordinates[0], expected);
}

TEST(GltfTextureCoordinates, SparseAndWithoutABufferView) {
  GltfFile gltf = triangleFile();
  const int indices = gltf.addView(GltfFile::toBytes(std::vector<std::uint8_t>{2}));
  const int values = gltf.addView(GltfFile::toBytes(std::vector<float>{0.5f, 0.75f}));
  attributes(gltf)["TEXCOORD_0"] =
      gltf.add("accessors", {{"componentType", 5126},
                             {"count", 3},
                             {"type", "VEC2"},
                             {"sparse",
                              {{"count", 1},
                               {"indices", {{"bufferView", indices}, {"componentType", 5121}}},
                               {"values", {{"bufferView", values}}}}}});
  EXPECT_EQ(readPart(gltf).textureCoordinates[0], (Coordinates{{0, 0}, {0, 0}, {0.5f, 0.75f}}));
}

TEST(GltfTextureCoordinates, InvalidValuesAreZeroWithANote) {
  GltfFile gltf = triangleFile();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<float>{nan, 0, 1, 2e6f, 0.5f, 1}, 5126, "VEC2");
  const SourceScene scene = readAll(gltf);
  EXPECT_EQ(scene.parts.at(0).polygons.textureCoordinates[0], (Coordinates{{0, 0}, {0, 0}, {0.5f, 1}}));
  EXPECT_TRUE(hasNote(scene, "out of range"));
  EXPECT_CONTAINS(test::errorMessage([&] { readAll(gltf, true); }), "texture coordinate 0", "out of range");
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<float>{0, 0, 1, 0}, 5126, "VEC2");
  EXPECT_CONTAINS(test::errorMessage([&] { readAll(gltf); }), "numbers of values and positions differ");
  attributes(gltf)["TEXCOORD_0"] = "x";
  EXPECT_CONTAINS(test::errorMessage([&] { readAll(gltf); }), "accessors", "does not exist");
}

TEST(GltfTextureCoordinates, OnlyMaterialsWithAnImageKeepThem) {
  GltfFile gltf = triangleFile();
  attributes(gltf)["TEXCOORD_0"] = addValues(gltf, std::vector<float>{0, 0, 1, 0, 0, 1}, 5126, "VEC2");
  attributes(gltf)["TANGENT"] = addValues(gltf, std::vector<float>(12, 1), 5126, "VEC4");
  SourceScene scene = test::readGlb(gltf);
  EXPECT_FALSE(scene.parts[0].polygons.hasTextureAttributes());
  EXPECT_TRUE(hasNote(scene, "texture coordinates that no texture uses (1)"));
  EXPECT_TRUE(hasNote(scene, "tangents that no normal map uses (1)"));
  gltf.document["images"] = {{{"uri", "missing.png"}}};
  gltf.document["textures"] = {{{"source", 0}}};
  gltf.document["materials"] = {{{"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
  gltf.document["meshes"][0]["primitives"][0]["material"] = 0;
  scene = test::readGlb(gltf);
  EXPECT_EQ(scene.parts[0].polygons.textureCoordinates[0].size(), 3u);
  EXPECT_FALSE(hasNote(scene, "texture coordinates"));
}

// A triangle with normals, and tangents along +x with bitangents along +y.
GltfFile tangentFile(json node = json::object()) {
  GltfFile gltf = triangleFile(std::move(node));
  attributes(gltf)["NORMAL"] = gltf.addVectors({{0, 0, 1}, {0, 0, 1}, {0, 0, 1}});
  attributes(gltf)["TANGENT"] = addValues(gltf, std::vector<float>{1, 0, 0, 1, 1, 0, 0, 1, 1, 0, 0, 1}, 5126, "VEC4");
  return gltf;
}

// Returns the bitangent of a corner of the merged polygons.
glm::vec3 bitangent(const Polygons& polygons, std::size_t corner) {
  const glm::vec4 t = polygons.tangents.at(corner);
  return t.w * glm::cross(polygons.normals.at(polygons.corners.at(corner)), glm::vec3(t));
}

TEST(GltfTangents, FollowTheTransformOfTheirNode) {
  const double h = std::sqrt(0.5);
  struct Case {
    json node;
    glm::vec3 tangent, bitangent;
  };
  const std::vector<Case> cases = {
      {json::object(), {1, 0, 0}, {0, 1, 0}},          {{{"rotation", {0, 0, h, h}}}, {0, 1, 0}, {-1, 0, 0}},
      {{{"scale", {3, 2, 1}}}, {1, 0, 0}, {0, 1, 0}},  {{{"scale", {-2, 1, 1}}}, {-1, 0, 0}, {0, 1, 0}},
      {{{"scale", {1, 1, -1}}}, {1, 0, 0}, {0, 1, 0}}, {{{"scale", {-1, -1, -1}}}, {-1, 0, 0}, {0, -1, 0}}};
  for (const Case& c : cases) {
    const Polygons merged = mergeInstances(readAll(tangentFile(c.node)));
    ASSERT_EQ(merged.tangents.size(), 3u);
    for (std::size_t corner = 0; corner < 3; ++corner) {
      EXPECT_LT(glm::distance(glm::vec3(merged.tangents[corner]), c.tangent), 1e-6f) << c.node;
      EXPECT_LT(glm::distance(bitangent(merged, corner), c.bitangent), 1e-6f) << c.node;
    }
  }
}

TEST(GltfTangents, FollowMorphTargetsAndJoints) {
  GltfFile gltf = tangentFile();
  gltf.document["meshes"][0]["primitives"][0]["targets"] = {
      {{"TANGENT", gltf.addVectors({{0, 2, 0}, {0, 0, 0}, {0, 0, 0}})}}};
  gltf.document["meshes"][0]["weights"] = {0.5};
  EXPECT_EQ(readPart(gltf).tangents[0], glm::vec4(1, 1, 0, 1));

  // A joint that mirrors x keeps the bitangents mirrored: along +y as before.
  gltf = tangentFile({{"skin", 0}});
  gltf.addNode({{"scale", {-1, 1, 1}}});
  gltf.document["skins"] = {{{"joints", {1}}}};
  attributes(gltf)["JOINTS_0"] = addValues(gltf, std::vector<std::uint8_t>(12, 0), 5121, "VEC4");
  attributes(gltf)["WEIGHTS_0"] = addValues(gltf, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0}, 5126, "VEC4");
  const Polygons skinned = readPart(gltf);
  for (std::size_t corner = 0; corner < 3; ++corner) {
    EXPECT_LT(glm::distance(glm::vec3(skinned.tangents.at(corner)), glm::vec3(-1, 0, 0)), 1e-6f);
    EXPECT_LT(glm::distance(bitangent(skinned, corner), glm::vec3(0, 1, 0)), 1e-6f);
  }
}

TEST(GltfTangents, InvalidOnesHaveNoDirection) {
  GltfFile gltf = tangentFile();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  attributes(gltf)["TANGENT"] =
      addValues(gltf, std::vector<float>{nan, 0, 0, 1, 1, 0, 0, 0.5f, 0, 1, 0, -1}, 5126, "VEC4");
  const SourceScene scene = readAll(gltf);
  EXPECT_EQ(scene.parts[0].polygons.tangents, (std::vector<glm::vec4>{{0, 0, 0, 1}, {0, 0, 0, 1}, {0, 1, 0, -1}}));
  EXPECT_TRUE(hasNote(scene, "invalid tangent"));
}

}  // namespace
}  // namespace malus::prep
