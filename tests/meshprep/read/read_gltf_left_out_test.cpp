// Invalid parts of glTF files: each kind is left out with a note and everything else is kept, or refused if strict.
#include "meshprep/read/read_gltf.h"

#include <cmath>
#include <limits>

#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::changed;
using test::errorIn;
using test::errorMessage;
using test::GltfFile;
using test::hasNote;
using test::readGlb;
using test::strictErrorIn;
using test::TemporaryFile;
using test::triangleFile;

// Node 0 has mesh 0. Node 1 has mesh 1, of two primitives, and the child 2 with mesh 0: four instances.
GltfFile threeNodes() {
  GltfFile gltf = triangleFile();
  json primitives = json::array();
  for (int i = 0; i < 2; ++i)
    primitives.push_back({{"attributes", {{"POSITION", gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})}}},
                          {"indices", gltf.addIndices(std::vector<std::uint16_t>{0, 1, 2})}});
  gltf.add("meshes", {{"name", "second"}, {"primitives", primitives}});
  gltf.addNode({{"mesh", 1}, {"children", {2}}, {"translation", {1, 2, 3}}});
  gltf.add("nodes", {{"mesh", 0}, {"name", "child"}});
  return gltf;
}

struct Case {
  const char* pointer;  // of the value that is replaced, or removed if null
  json value;
  std::size_t instances;  // that are left
  const char* note;
};

void expectLeftOut(const Case& c) {
  const GltfFile gltf = changed(threeNodes(), c.pointer, c.value);
  SCOPED_TRACE(std::string(c.pointer) + " " + c.value.dump());
  EXPECT_EQ(errorIn(gltf), "");
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.instances.size(), c.instances);
  EXPECT_TRUE(hasNote(scene, c.note)) << json(scene.notes).dump();
  EXPECT_CONTAINS(strictErrorIn(gltf), c.note);
}

TEST(ReadGltf, LeavesOutInvalidNodes) {
  EXPECT_EQ(readGlb(threeNodes()).instances.size(), 4u);
  EXPECT_TRUE(readGlb(threeNodes()).notes.empty());
  for (const Case& c : std::vector<Case>{
           {"/nodes/1", 7, 1, "nodes[1]: wrong type"},
           {"/nodes/1", json::array(), 1, "nodes[1]: wrong type"},
           {"/nodes/1/mesh", "1", 2, "nodes[1].mesh: wrong type"},
           {"/nodes/1/mesh", -1, 2, "nodes[1].mesh: wrong type"},
           {"/nodes/1/mesh", 0.5, 2, "nodes[1].mesh: wrong type"},
           {"/nodes/1/mesh", 9, 2, "nodes[1].mesh: refers to a missing mesh"},
           {"/nodes/1/matrix", "identity", 1, "nodes[1].matrix: wrong type"},
           {"/nodes/1/matrix", {1, 2, 3}, 1, "nodes[1].matrix: wrong type"},
           {"/nodes/1/translation", {1, 2, "3"}, 1, "nodes[1].translation: wrong type"},
           {"/nodes/1/rotation", json::object(), 1, "nodes[1].rotation: wrong type"},
           {"/nodes/1/scale", 2, 1, "nodes[1].scale: wrong type"},
           {"/nodes/1/name", 3, 4, "nodes[1].name: wrong type"},
           {"/nodes/1/children", "2", 3, "nodes[1].children: wrong type"},
           {"/nodes/1/children", {2, "x"}, 4, "nodes[1].children[1]: wrong type"},
           {"/nodes/1/children", {json::array(), 2}, 4, "nodes[1].children[0]: wrong type"},
           {"/nodes/1/children", {2, 99}, 4, "nodes[1].children: refers to a missing node"},
           {"/nodes/1/children", {2, 2}, 4, "nodes[2]: node has two parents"},
           {"/nodes/0/children", {2}, 4, "nodes[2]: node has two parents"},
           {"/nodes/2/children", {2}, 4, "nodes[2]: node has two parents"},
           {"/nodes/1/children", {1}, 1, "nodes[1]: node is its own ancestor"},
           {"/nodes/2/children", {1}, 1, "node is its own ancestor"},
       })
    expectLeftOut(c);
}

TEST(ReadGltf, LeavesOutInvalidScenes) {
  for (const Case& c : std::vector<Case>{
           {"/scene", "0", 4, "scene: wrong type"},
           {"/scene", 5, 4, "scene: refers to a missing scene"},
           {"/scenes/1", 5, 4, "scenes[1]: wrong type"},
           {"/scenes/0/nodes", {0, 1, "x"}, 4, "scenes[0].nodes[2]: wrong type"},
           {"/scenes/0/nodes", {0, 1, 9}, 4, "scenes[0].nodes: refers to a missing node"},
           {"/scenes/0/nodes", {0, 1, 0}, 4, "scenes[0].nodes: node 0"},
           {"/scenes/0/nodes", {0, 1, 2}, 4, "scenes[0].nodes: node 2"},
           {"/extensionsUsed", "KHR_draco", 4, "extensionsUsed: wrong type"},
           {"/extensionsUsed", {3}, 4, "extensionsUsed: wrong type"},
       })
    expectLeftOut(c);
  EXPECT_CONTAINS(errorIn(changed(threeNodes(), "/scenes/0/nodes", "0")), "scenes[0].nodes: wrong type");
}

TEST(ReadGltf, LeavesOutInvalidMeshes) {
  for (const Case& c : std::vector<Case>{
           {"/meshes/1", json::array(), 2, "meshes[1]: wrong type"},
           {"/meshes/1/primitives", json::object(), 2, "meshes[1].primitives: wrong type"},
           {"/meshes/1/primitives", nullptr, 2, "meshes[1].primitives: missing key"},
           {"/meshes/1/name", json::array(), 4, "meshes[1].name: wrong type"},
           {"/meshes/1/primitives/0", "x", 3, "meshes[1].primitives[0]: wrong type"},
           {"/meshes/1/primitives/0/mode", "TRIANGLES", 3, "primitives[0].mode: wrong type"},
           {"/meshes/1/primitives/0/mode", 7, 3, "primitives[0].mode: unknown mode"},
           {"/meshes/1/primitives/0/indices", {3}, 3, "primitives[0].indices: wrong type"},
           {"/meshes/1/primitives/0/material", "red", 3, "primitives[0].material: wrong type"},
           {"/meshes/1/primitives/0/attributes", json::array(), 3, "primitives[0].attributes: wrong type"},
           {"/meshes/1/primitives/0/attributes", nullptr, 3, "primitives[0].attributes: missing key"},
           {"/meshes/1/primitives/0/attributes/POSITION", json::object(), 3, "attributes.POSITION: wrong type"},
           {"/meshes/1/primitives/0/attributes/NORMAL", "n", 3, "attributes.NORMAL: wrong type"},
           {"/meshes/1/primitives/0/extensions", 3, 3, "primitives[0].extensions: wrong type"},
           {"/meshes/1/primitives/0/extensions",
            {{"KHR_draco_mesh_compression", {{"bufferView", 0}}}},
            3,
            "KHR_draco_mesh_compression.attributes: missing key"},
       })
    expectLeftOut(c);
}

TEST(ReadGltf, LeavesOutInvalidAccessorsAndViews) {
  for (const Case& c : std::vector<Case>{
           {"/accessors/2", 1, 3, "accessors[2]: wrong type"},
           {"/accessors/2/count", "3", 3, "accessors[2].count: wrong type"},
           {"/accessors/2/count", -3, 3, "accessors[2].count: wrong type"},
           {"/accessors/2/count", nullptr, 3, "accessors[2].count: missing key"},
           {"/accessors/2/componentType", "FLOAT", 3, "accessors[2].componentType: wrong type"},
           {"/accessors/2/componentType", 5124, 3, "accessors[2].componentType: unknown"},
           {"/accessors/2/type", 3, 3, "accessors[2].type: wrong type"},
           {"/accessors/2/type", "VEC5", 3, "accessors[2].type: unknown"},
           {"/accessors/2/normalized", 1, 3, "accessors[2].normalized: wrong type"},
           {"/accessors/2/bufferView", "0", 3, "accessors[2].bufferView: wrong type"},
           {"/accessors/2/byteOffset", json::object(), 3, "accessors[2].byteOffset: wrong type"},
           {"/accessors/2/sparse", json::array(), 3, "accessors[2].sparse: wrong type"},
           {"/accessors/2/sparse", {{"count", 1}}, 3, "accessors[2].sparse.indices: missing key"},
           {"/accessors/3/count", "3", 3, "accessors[3].count: wrong type"},
           {"/accessors/6", {{"count", 1}}, 4, "accessors[6].componentType: missing key"},
           {"/bufferViews/2", "x", 3, "bufferViews[2]: wrong type"},
           {"/bufferViews/2/byteLength", "36", 3, "bufferViews[2].byteLength: wrong type"},
           {"/bufferViews/2/byteStride", 13, 3, "bufferViews[2].byteStride: invalid stride"},
           {"/bufferViews/2/buffer", 1, 3, "buffers[1]: does not exist"},
       })
    expectLeftOut(c);

  GltfFile gltf = threeNodes();
  gltf.document["buffers"] = {{{"byteLength", gltf.bin.size()}}, {{"uri", 3}, {"byteLength", 36}}};
  gltf.document["bufferViews"][2] = {{"buffer", 1}, {"byteLength", 36}};
  EXPECT_EQ(readGlb(gltf).instances.size(), 3u);
  EXPECT_TRUE(hasNote(readGlb(gltf), "buffers[1].uri: wrong type"));
  EXPECT_TRUE(hasNote(readGlb(gltf), "meshes[1].primitives[0]: buffers[1]: is invalid"));
  EXPECT_CONTAINS(strictErrorIn(gltf), "buffers[1].uri: wrong type");
}

TEST(ReadGltf, NamesWhatRefersToInvalidItems) {
  EXPECT_TRUE(hasNote(readGlb(changed(threeNodes(), "/meshes/1", 3)), "nodes[1].mesh: refers to an invalid mesh"));
  EXPECT_TRUE(
      hasNote(readGlb(changed(threeNodes(), "/accessors/2", 3)), "meshes[1].primitives[0]: accessors[2]: is invalid"));
}

TEST(ReadGltf, LeavesOutInvalidCamerasAndLights) {
  for (const Case& c : std::vector<Case>{
           {"/cameras", "x", 4, "cameras: wrong type"},
           {"/cameras", {3}, 4, "cameras[0]: wrong type"},
           {"/nodes/1/camera", "x", 4, "nodes[1].camera: wrong type"},
           {"/nodes/1/camera", 3, 4, "cameras"},
           {"/nodes/1/extensions", "x", 4, "nodes[1].extensions: wrong type"},
           {"/nodes/1/extensions", {{"KHR_lights_punctual", json::object()}}, 4, "KHR_lights_punctual.light: missing"},
           {"/extensions", "x", 4, "extensions: wrong type"},
           {"/extensions", {{"KHR_lights_punctual", 3}}, 4, "extensions.KHR_lights_punctual: wrong type"},
           {"/extensions", {{"KHR_lights_punctual", {{"lights", "x"}}}}, 4, "lights: wrong type"},
           {"/extensions", {{"KHR_lights_punctual", {{"lights", {"x"}}}}}, 4, "lights[0]: wrong type"},
       })
    expectLeftOut(c);
}

TEST(ReadGltf, RefusesListsOfTheWrongType) {
  for (const char* key : {"scenes", "nodes", "meshes", "accessors", "bufferViews", "buffers", "materials"})
    for (const json& value : {json(3), json::object(), json("x"), json(nullptr)}) {
      GltfFile gltf = threeNodes();
      gltf.document["buffers"] = {{{"byteLength", gltf.bin.size()}}};
      gltf.document[key] = value;
      EXPECT_CONTAINS(errorIn(gltf), key, "wrong type", "list");
    }
}

TEST(ReadGltf, DoesNotCheckIgnoredContent) {
  GltfFile gltf = threeNodes();
  for (const char* key : {"animations", "extras"}) gltf.document[key] = "x";
  for (const char* key : {"extras", "unknown"}) gltf.document["nodes"][1][key] = "x";
  json& primitive = gltf.document["meshes"][1]["primitives"][0];
  primitive["attributes"]["_TEMPERATURE"] = "x";
  primitive["attributes"]["TEXCOORD_0"] = "x";
  EXPECT_EQ(readGlb(gltf).instances.size(), 4u);
  EXPECT_EQ(strictErrorIn(gltf), "");
}

TEST(ReadGltf, RefusesFilesWithNothingLeft) {
  GltfFile gltf = triangleFile();
  gltf.document["accessors"][0]["count"] = "3";
  gltf.document["meshes"][0]["name"] = 3;
  EXPECT_CONTAINS(errorIn(gltf), "accessors[0].count: wrong type", "found \"3\"");
}

TEST(ReadGltf, ReadsRootsWithoutScenesBesideInvalidNodes) {
  GltfFile gltf = threeNodes();
  gltf.document.erase("scenes");
  EXPECT_EQ(readGlb(gltf).instances.size(), 4u);
  EXPECT_EQ(readGlb(changed(gltf, "/nodes/1/matrix", "x")).instances.size(), 1u);  // not its child as a root
  EXPECT_EQ(readGlb(changed(gltf, "/nodes/0", "x")).instances.size(), 3u);
  EXPECT_EQ(readGlb(changed(gltf, "/nodes/2/children", {2})).instances.size(), 4u);
  EXPECT_CONTAINS(errorIn(changed(gltf, "/nodes/1/children", "2")), "nodes[1].children", "root nodes");
}

TEST(ReadGltf, AcceptsIntegersWithADecimalPoint) {
  GltfFile gltf = threeNodes();
  gltf.document["nodes"][1]["mesh"] = 1.0;
  gltf.document["accessors"][2]["count"] = 3.0;
  gltf.document["nodes"][1]["children"] = {2.0};
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.instances.size(), 4u);
  EXPECT_EQ(scene.notes.size(), 1u);
  EXPECT_TRUE(hasNote(scene, std::string(kAcceptedNote) + "integers"));
}

// A list of triangles, or a strip, with the given corners and positions.
template <class Index>
GltfFile primitiveFile(const std::vector<glm::vec3>& points, const std::vector<Index>& corners, int mode = 4) {
  GltfFile gltf;
  const json primitive = {
      {"attributes", {{"POSITION", gltf.addVectors(points)}}}, {"indices", gltf.addIndices(corners)}, {"mode", mode}};
  gltf.add("meshes", {{"primitives", {primitive}}});
  gltf.addNode({{"mesh", 0}});
  return gltf;
}

TEST(ReadGltf, LeavesOutInvalidTriangles) {
  using Corners = std::vector<std::uint32_t>;
  const std::vector<glm::vec3> points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}};
  const auto corners = [](const GltfFile& gltf, const char* note) {
    const SourceScene scene = readGlb(gltf);
    EXPECT_TRUE(hasNote(scene, note)) << json(scene.notes).dump();
    EXPECT_NE(strictErrorIn(gltf), "");
    for (const glm::dvec3& p : scene.parts.at(0).polygons.positions)
      EXPECT_TRUE(std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z));
    EXPECT_EQ(scene.parts.at(0).polygons.faceCount(), scene.parts.at(0).polygons.corners.size() / 3);
    return scene.parts.at(0).polygons.corners;
  };
  const std::vector<std::uint16_t> outside = {0, 1, 9, 2, 1, 3, 7, 7, 7};
  EXPECT_EQ(corners(primitiveFile(points, outside), "primitives[0]: 2 invalid triangles"), (Corners{2, 1, 3}));
  EXPECT_EQ(corners(primitiveFile(points, outside), "accessors[1]: invalid vertex index at 2"), (Corners{2, 1, 3}));
  const std::vector<std::uint8_t> restart = {0, 1, 2, 2, 1, 255};
  EXPECT_EQ(corners(primitiveFile(points, restart), "primitive restart at 5"), (Corners{0, 1, 2}));
  const std::vector<std::uint16_t> strip = {0, 1, 2, 9};
  EXPECT_EQ(corners(primitiveFile(points, strip, 5), "1 invalid triangle,"), (Corners{0, 1, 2}));

  // Positions that are not finite: of a face, and of none.
  for (const float bad : {std::numeric_limits<float>::quiet_NaN(), -std::numeric_limits<float>::infinity()}) {
    std::vector<glm::vec3> invalid = points;
    invalid[3].y = bad;
    const std::vector<std::uint16_t> both = {0, 1, 2, 2, 1, 3};
    EXPECT_EQ(corners(primitiveFile(invalid, both), "accessors[0]: element 3 is not finite"), (Corners{0, 1, 2}));
    const std::vector<std::uint16_t> unused = {0, 1, 2};
    const GltfFile gltf = primitiveFile(invalid, unused);
    EXPECT_EQ(readGlb(gltf).parts.at(0).polygons.corners, (Corners{0, 1, 2}));
    EXPECT_TRUE(std::isfinite(readGlb(gltf).parts.at(0).polygons.positions.at(3).y));
    EXPECT_CONTAINS(strictErrorIn(gltf), "accessors[0]", "finite");
  }
}

TEST(ReadGltf, LeavesOutNormalsThatAreNotFinite) {
  GltfFile gltf = triangleFile();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  gltf.document["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] =
      gltf.addVectors({{0, 0, 1}, {0, nan, 1}, {0, 0, 1}});
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.parts.at(0).polygons.normals, (std::vector<glm::vec3>{{0, 0, 1}, {0, 0, 0}, {0, 0, 1}}));
  EXPECT_TRUE(hasNote(scene, "accessors[2]: element 1 is not finite"));
  EXPECT_CONTAINS(strictErrorIn(gltf), "accessors[2]: element 1");
}

TEST(ReadGltf, ListsBufferFilesThatMayBeOpened) {
  GltfFile gltf = triangleFile();
  gltf.document["buffers"] = json::parse(R"([{"uri": "a.bin", "byteLength": 44}, {"uri": "../b.bin", "byteLength": 4},
                                             {"uri": 3, "byteLength": 4}, "x"])");
  const TemporaryFile file(".gltf", gltf.document.dump());
  EXPECT_EQ(gltfFiles(file.path()), std::vector{file.path().parent_path() / "a.bin"});
}

}  // namespace
}  // namespace malus::prep
