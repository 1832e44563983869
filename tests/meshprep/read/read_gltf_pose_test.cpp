// Default poses and instances of glTF: morph targets, skins, EXT_mesh_gpu_instancing, hidden nodes.
#include <cmath>

#include <glm/geometric.hpp>

#include "meshprep/read/read_gltf.h"
#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::errorIn;
using test::GltfFile;
using test::hasNote;
using test::readGlb;
using test::strictErrorIn;
using test::triangleFile;

json& firstPrimitive(GltfFile& gltf) { return gltf.document["meshes"][0]["primitives"][0]; }

template <class Number>
int addValues(GltfFile& gltf, const std::vector<Number>& values, int componentType, std::size_t count,
              const char* type) {
  return gltf.addAccessor(gltf.addView(GltfFile::toBytes(values)), componentType, count, type);
}

void expectNear(const glm::dvec3& found, const glm::dvec3& expected) {
  EXPECT_LT(glm::distance(found, expected), 1e-6) << found.x << " " << found.y << " " << found.z;
}

TEST(GltfPose, DefaultMorphWeightsAreApplied) {
  GltfFile gltf = triangleFile();
  const int up = gltf.addVectors({{0, 0, 1}, {0, 0, 2}, {0, 0, 3}}),
            right = gltf.addVectors({{1, 0, 0}, {0, 0, 0}, {0, 0, 0}});
  firstPrimitive(gltf)["targets"] = {{{"POSITION", up}}, {{"POSITION", right}}};
  expectNear(readGlb(gltf).parts[0].polygons.positions[1], {1, 0, 0});  // weights are 0 if absent
  gltf.document["meshes"][0]["weights"] = {0.5, 2};
  SourceScene scene = readGlb(gltf);
  expectNear(scene.parts[0].polygons.positions[0], {2, 0, 0.5});
  expectNear(scene.parts[0].polygons.positions[2], {0, 1, 1.5});
  EXPECT_FALSE(hasNote(scene, "morph"));
  // The weights of a node replace those of its mesh; each pose is a part.
  gltf.addNode({{"mesh", 0}, {"weights", {-1, 0}}});
  gltf.addNode({{"mesh", 0}});
  scene = readGlb(gltf);
  ASSERT_EQ(scene.parts.size(), 2u);
  ASSERT_EQ(scene.instances.size(), 3u);
  expectNear(scene.parts[scene.instances[1].part].polygons.positions[2], {0, 1, -3});
  EXPECT_EQ(scene.instances[0].part, scene.instances[2].part);
}

TEST(GltfPose, MorphTargetsOfAWrongNumberAreLeftOut) {
  GltfFile gltf = triangleFile();
  firstPrimitive(gltf)["targets"] = {{{"POSITION", gltf.addVectors({{0, 0, 1}, {0, 0, 2}})}}};
  gltf.document["meshes"][0]["weights"] = {1};
  EXPECT_CONTAINS(errorIn(gltf), "numbers of values and positions differ");
  gltf.document["meshes"][0]["weights"] = {"x"};
  EXPECT_EQ(errorIn(gltf), "");
  EXPECT_CONTAINS(strictErrorIn(gltf), "meshes[0].weights");
}

// A triangle at a node that is moved, with a joint at (0, 0, 7) and one that is turned about +z by 90 degrees.
GltfFile skinnedFile() {
  GltfFile gltf = triangleFile({{"skin", 0}, {"translation", {100, 0, 0}}});
  gltf.addNode({{"name", "lifted"}, {"translation", {0, 0, 7}}});
  gltf.addNode({{"name", "turned"}, {"rotation", {0, 0, std::sqrt(0.5), std::sqrt(0.5)}}});
  gltf.document["skins"] = {{{"joints", {1, 2}}}};
  firstPrimitive(gltf)["attributes"]["JOINTS_0"] =
      addValues(gltf, std::vector<std::uint8_t>{0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, 5121, 3, "VEC4");
  firstPrimitive(gltf)["attributes"]["WEIGHTS_0"] =
      addValues(gltf, std::vector<float>{1, 0, 0, 0, 1, 0, 0, 0, 0.25f, 0.75f, 0, 0}, 5126, 3, "VEC4");
  return gltf;
}

TEST(GltfPose, OnlyTheJointsPlaceASkinnedMesh) {
  const SourceScene scene = readGlb(skinnedFile());
  ASSERT_EQ(scene.instances.size(), 1u);
  EXPECT_EQ(scene.instances[0].worldFromObject, glm::dmat4(1.0));
  const auto& positions = scene.parts[0].polygons.positions;
  expectNear(positions[0], {0, 0, 7});
  expectNear(positions[1], {0, 1, 0});
  expectNear(positions[2], glm::dvec3(0, 1, 7) * 0.25 + glm::dvec3(-1, 0, 0) * 0.75);
  EXPECT_FALSE(hasNote(scene, "skin"));
}

TEST(GltfPose, InverseBindMatricesComeFirst) {
  GltfFile gltf = skinnedFile();
  std::vector<float> matrices(32, 0.0f);
  for (const std::size_t m : {0u, 16u})
    for (const std::size_t i : {0u, 5u, 10u, 15u}) matrices[m + i] = 1;
  matrices[16 + 12] = -1;  // joint 1 was at (1, 0, 0) when it was bound
  gltf.document["skins"][0]["inverseBindMatrices"] = addValues(gltf, matrices, 5126, 2, "MAT4");
  expectNear(readGlb(gltf).parts[0].polygons.positions[1], {0, 0, 0});
}

TEST(GltfPose, AMirroringJointKeepsTheOutside) {
  GltfFile gltf = skinnedFile();
  for (const std::size_t joint : {1u, 2u}) gltf.document["nodes"][joint] = {{"scale", {-1, 1, 1}}};
  const Polygons polygons = readGlb(gltf).parts[0].polygons;
  const auto corner = [&](std::size_t i) { return polygons.positions[polygons.corners[i]]; };
  EXPECT_GT(glm::cross(corner(1) - corner(0), corner(2) - corner(0)).z, 0);
}

TEST(GltfPose, InvalidSkinsLeaveTheMeshOut) {
  const auto changed = [](auto change) {
    GltfFile gltf = skinnedFile();
    change(gltf);
    return errorIn(gltf);
  };
  EXPECT_CONTAINS(changed([](GltfFile& g) { g.document["nodes"][0]["skin"] = 3; }), "nodes[0].skin", "missing skin");
  EXPECT_CONTAINS(changed([](GltfFile& g) {
                    g.document["skins"][0]["joints"] = {1, 9};
                  }),
                  "joints[1]", "not in the scene");
  EXPECT_CONTAINS(changed([](GltfFile& g) { g.document["skins"][0]["joints"] = {1}; }), "joint of vertex", "below 1");
  EXPECT_CONTAINS(changed([](GltfFile& g) { g.document["skins"][0]["joints"] = json::array(); }), "no joints");
  EXPECT_CONTAINS(changed([](GltfFile& g) { g.document["skins"][0]["inverseBindMatrices"] = 0; }), "wrong type");
  EXPECT_CONTAINS(changed([](GltfFile& g) { firstPrimitive(g)["attributes"].erase("WEIGHTS_0"); }),
                  "joints without weights");
  EXPECT_CONTAINS(changed([](GltfFile& g) {
                    firstPrimitive(g)["attributes"].erase("WEIGHTS_0");
                    firstPrimitive(g)["attributes"].erase("JOINTS_0");
                  }),
                  "no weight of a joint");
}

TEST(GltfPose, GpuInstancesReplaceTheMeshOfTheNode) {
  GltfFile gltf = triangleFile({{"translation", {0, 10, 0}}});
  gltf.document["extensionsRequired"] = {"EXT_mesh_gpu_instancing"};
  const json attributes = {{"TRANSLATION", gltf.addVectors({{-1, 0, 0}, {1, 0, 0}, {5, 0, 0}})},
                           {"ROTATION",
                            [&] {
                              const int index =
                                  addValues(gltf, std::vector<std::int8_t>{0, 0, 0, 127, 0, 0, 90, 90, 0, 0, 0, 127},
                                            5120, 3, "VEC4");
                              gltf.document["accessors"][static_cast<std::size_t>(index)]["normalized"] = true;
                              return index;
                            }()},
                           {"SCALE", gltf.addVectors({{1, 1, 1}, {2, 2, 2}, {0, 0, 0}})}};
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", attributes}};
  const SourceScene scene = readGlb(gltf);
  ASSERT_EQ(scene.instances.size(), 2u);  // the third one is hidden
  EXPECT_TRUE(hasNote(scene, "hidden by a scale of 0 (1"));
  expectNear(glm::dvec3(scene.instances[0].worldFromObject * glm::dvec4(1, 0, 0, 1)), {0, 10, 0});
  expectNear(glm::dvec3(scene.instances[1].worldFromObject * glm::dvec4(1, 0, 0, 1)), {1, 12, 0});
  EXPECT_NE(scene.instances[0].name, scene.instances[1].name);

  const auto error = [&](const char* key, const json& value) {
    GltfFile other = gltf;
    other.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"]["attributes"][key] = value;
    return errorIn(other);
  };
  EXPECT_CONTAINS(error("SCALE", gltf.addVectors({{1, 1, 1}})), "instances differ");
  EXPECT_CONTAINS(error("ROTATION", attributes["SCALE"]), "wrong type");
  EXPECT_CONTAINS(error("TRANSLATION", 99), "accessors[99]");
  gltf.document["nodes"][0]["extensions"]["EXT_mesh_gpu_instancing"] = {{"attributes", json::object()}};
  EXPECT_CONTAINS(errorIn(gltf), "no instances");
}

TEST(GltfPose, AScaleOfZeroHidesWithoutAnError) {
  GltfFile gltf = triangleFile();
  gltf.addNode({{"mesh", 0}, {"name", "hidden"}, {"scale", {0, 0, 0}}});
  gltf.addNode({{"mesh", 0}, {"name", "flat"}, {"scale", {1, 0, 1}}});
  gltf.addNode({{"scale", {0, 1, 1}}, {"children", {4}}});
  gltf.add("nodes", {{"mesh", 0}, {"name", "below"}});
  EXPECT_EQ(strictErrorIn(gltf), "");
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(hasNote(scene, "hidden by a scale of 0 (3: 'hidden', 'flat', 'below')"));
}

TEST(GltfPose, UnknownKeysAndExtensionsAreNoted) {
  GltfFile gltf = triangleFile();
  gltf.document["materials"] = {
      {{"alphaCutoff", 0.3}, {"extensions", {{"KHR_materials_sheen", {{"sheenRoughnessFactor", 1}}}}}},
      {{"extensions", {{"KHR_materials_sheen", json::object()}, {"KHR_materials_ior", {{"typo", 1}}}}}}};
  gltf.document["nodes"][0]["extensions"]["VENDOR_thing"] = {{"x", 1}};
  gltf.document["extras"] = {{"anything", 1}};
  gltf.document["asset"]["generator"] = "a test";
  gltf.document["accessors"][0]["min"] = {0, 0, 0};
  gltf.document["extensionsUsed"] = {"KHR_materials_sheen", "VENDOR_unused"};
  const SourceScene scene = readGlb(gltf);
  EXPECT_TRUE(hasNote(scene, "extension KHR_materials_sheen (2"));
  EXPECT_TRUE(hasNote(scene, "extension VENDOR_thing (1"));
  EXPECT_TRUE(hasNote(scene, "extension VENDOR_unused"));
  EXPECT_FALSE(hasNote(scene, "alphaCutoff"));
  EXPECT_TRUE(hasNote(scene, "key 'materials.extensions.KHR_materials_ior.typo' (1"));
  EXPECT_EQ(scene.notes.size(), 4u);
}

TEST(GltfPose, BytesBehindAGlbAreNoted) {
  const test::TemporaryFile longer(".glb", triangleFile().glb() + std::string(4, 'x'));
  const SourceScene scene = readGltf(longer.path(), true);
  EXPECT_TRUE(hasNote(scene, "4 bytes behind the end"));
  const std::string bytes = triangleFile().glb();
  const test::TemporaryFile shorter(".glb", bytes.substr(0, bytes.size() - 4));
  EXPECT_CONTAINS(test::errorMessage([&] { readGltf(shorter.path()); }), "unexpected end of file");
}

}  // namespace
}  // namespace malus::prep
