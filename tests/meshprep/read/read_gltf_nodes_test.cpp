// Nodes of glTF: transforms, instances, and errors in the graph.
#include "meshprep/read/read_gltf.h"

#include <glm/geometric.hpp>

#include "meshprep/prepare.h"
#include "meshprep/read/read_mesh.h"
#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep {
namespace {

using nlohmann::json;
using test::errorIn;
using test::GltfFile;
using test::hasNote;
using test::readGlb;
using test::strictErrorIn;
using test::TemporaryFile;
using test::triangleFile;

TEST(ReadGltf, TraversesTheNodeGraph) {
  GltfFile gltf = triangleFile();
  gltf.document["nodes"] = json::parse(R"([
    {"children": [1, 2], "translation": [10, 0, 0]},
    {"mesh": 0, "name": "a", "rotation": [0, 0, 0.7071067811865476, 0.7071067811865476], "scale": [2, 3, 4]},
    {"children": [3], "matrix": [0, 0, -1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 1, 2, 3, 1]},
    {"mesh": 0, "translation": [0, 0, 5]}])");
  const SourceScene scene = readGlb(gltf);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.instances[0].name, "a");
  EXPECT_EQ(scene.instances[1].name, "node 3");
  // (1, 0, 0) is scaled to 2, rotated about +z to (0, 2, 0), and moved by 10; the matrix maps +z to +x.
  EXPECT_LT(glm::distance(scene.instances[0].worldFromObject * glm::dvec4(1, 0, 0, 1), glm::dvec4(10, 2, 0, 1)), 1e-12);
  EXPECT_LT(glm::distance(scene.instances[0].worldFromObject * glm::dvec4(0, 1, 1, 1), glm::dvec4(7, 0, 4, 1)), 1e-12);
  EXPECT_EQ(scene.instances[1].worldFromObject * glm::dvec4(0, 0, 0, 1), glm::dvec4(16, 2, 3, 1));
  EXPECT_EQ(scene.instances[1].worldFromObject * glm::dvec4(1, 0, 0, 1), glm::dvec4(16, 2, 2, 1));

  const auto error = [&](const char* nodes, const char* roots = "[0]") {
    gltf.document["nodes"] = json::parse(nodes);
    gltf.document["scenes"][0]["nodes"] = json::parse(roots);
    return strictErrorIn(gltf);
  };
  EXPECT_CONTAINS(error(R"([{"mesh": 0}, {"children": [2]}, {"children": [1]}])"), "nodes[1]", "ancestor");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "children": [0]}])"), "nodes[0]", "ancestor");
  EXPECT_CONTAINS(error(R"([{"children": [1, 1]}, {"mesh": 0}])"), "nodes[1]", "two parents");
  EXPECT_CONTAINS(error(R"([{"children": [2]}, {"children": [2]}, {"mesh": 0}])", "[0, 1]"), "nodes[2]", "two parent");
  EXPECT_CONTAINS(error(R"([{"children": [3]}, {"mesh": 0}])"), "nodes[0].children", "missing");
  EXPECT_CONTAINS(error(R"([{"children": [1]}, {"mesh": 0}])", "[1]"), "node 1", "parent");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "matrix": [1,0,0,0, 1,0,0,0, 0,0,1,0, 0,0,0,1]}])"),
                  "nodes[0]: transform is singular");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "scale": [1e300, 1, 1]}])"), "transform", "range");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "rotation": [0, 0, 0, 0]}])"), "nodes[0].rotation", "length");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "matrix": [1, 2, 3]}])"), "nodes[0].matrix", "type", "16");
  EXPECT_CONTAINS(error(R"([{"mesh": 0, "matrix": [1,0,0,1, 0,1,0,0, 0,0,1,0, 0,0,0,1]}])"), "matrix", "affine");

  // A chain that is deeper than any call stack.
  json chain = json::array();
  for (int i = 1; i < 100'000; ++i) chain.push_back({{"children", {i}}});
  chain.push_back({{"mesh", 0}});
  EXPECT_EQ(error(chain.dump().c_str()), "");
}

TEST(ReadGltf, ReadsRootsWithoutScenes) {
  GltfFile gltf = triangleFile();
  gltf.document.erase("scenes");
  EXPECT_EQ(readGlb(gltf).instances.size(), 1u);
  gltf.document["scenes"] = json::parse(R"([{"nodes": []}, {"nodes": [0]}])");
  EXPECT_CONTAINS(errorIn(gltf), "no mesh");
  gltf.document["scene"] = 1;
  EXPECT_TRUE(hasNote(readGlb(gltf), "scenes other than number 1 of 2"));
}

TEST(ReadGltf, FlipsFacesOfMirroredInstances) {
  GltfFile gltf;
  gltf.addMesh(test::cube(), "cube");
  gltf.addNode({{"mesh", 0}, {"scale", {-1, 2, 3}}, {"translation", {7, 0, 0}}});
  gltf.addNode({{"mesh", 0}});
  const TemporaryFile file(".glb", gltf.glb());
  const Polygons whole = readMesh(file.path());
  ASSERT_EQ(whole.parts.size(), 2u);
  EXPECT_EQ(whole.faceCount(), 24u);
  double volumes[2] = {0, 0};
  for (std::size_t f = 0; f < whole.faceCount(); ++f) {
    const auto face = whole.face(f);
    volumes[whole.partOf[f]] +=
        glm::dot(whole.positions[face[0]], glm::cross(whole.positions[face[1]], whole.positions[face[2]])) / 6;
  }
  EXPECT_NEAR(volumes[0], 6, 1e-12);
  EXPECT_NEAR(volumes[1], 1, 1e-12);
  Report report;
  EXPECT_EQ(prepare(file.path(), {}, report).triangles.size(), 24u);
  EXPECT_EQ(report.count("faces-flipped"), 0u);
}

TEST(ReadGltf, LimitsInstances) {
  // 2000 instances of 6000 triangles from a small file.
  GltfFile gltf;
  const int position = gltf.addVectors({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}});
  std::vector<std::uint8_t> indices;
  for (int i = 0; i < 6000; ++i) indices.insert(indices.end(), {0, 1, 2});
  gltf.add("meshes",
           {{"primitives", {{{"attributes", {{"POSITION", position}}}, {"indices", gltf.addIndices(indices)}}}}});
  for (int i = 0; i < 2000; ++i) gltf.addNode({{"mesh", 0}});
  EXPECT_CONTAINS(errorIn(gltf), "instances", "65536", "4000000");
  // Primitives that share their indices.
  json& primitives = gltf.document["meshes"][0]["primitives"];
  const json one = primitives[0];
  for (int i = 0; i < 400; ++i) primitives.push_back(one);
  EXPECT_CONTAINS(errorIn(gltf), "too many triangles");
}

TEST(ReadGltf, LeavesOutNodesWithInvalidTransforms) {
  GltfFile gltf = triangleFile();
  gltf.addNode({{"name", "bad"}, {"mesh", 0}, {"rotation", {0, 0, 0, 0}}});
  const SourceScene scene = readGlb(gltf);
  EXPECT_EQ(scene.instances.size(), 1u);
  EXPECT_TRUE(hasNote(scene, "nodes[1].rotation"));
}

}  // namespace
}  // namespace malus::prep
