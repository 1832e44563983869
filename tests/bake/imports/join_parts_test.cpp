// Bodies of glass that a file spreads over primitives, nodes and materials.
#include "bake/imports/join_parts.h"

#include <algorithm>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "tests/bake/fixtures.h"
#include "tests/meshprep/read/gltf_files.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::contains;
using test::errorMessage;

// Side of the unit cube as two triangles, with its own vertices: 0 and 1 at low and high x, 2 and 3 y, 4 and 5 z.
prep::Mesh side(int index, const glm::dvec3& offset = glm::dvec3(0)) {
  const int axis = index / 2, u = (axis + 1) % 3, v = (axis + 2) % 3;
  prep::Mesh mesh;
  for (int i = 0; i < 4; ++i) {
    glm::dvec3 p(0);
    p[axis] = index % 2, p[u] = i & 1, p[v] = (i >> 1) & 1;
    mesh.positions.push_back(p + offset);
  }
  mesh.triangles =
      index % 2 == 1 ? std::vector<glm::uvec3>{{0, 1, 3}, {0, 3, 2}} : std::vector<glm::uvec3>{{0, 3, 1}, {0, 2, 3}};
  return mesh;
}

prep::Mesh sides(const std::vector<int>& indices, const glm::dvec3& offset = glm::dvec3(0)) {
  prep::Mesh result;
  for (const int index : indices) {
    const prep::Mesh one = side(index, offset);
    const auto first = static_cast<std::uint32_t>(result.positions.size());
    result.positions.insert(result.positions.end(), one.positions.begin(), one.positions.end());
    for (const glm::uvec3& t : one.triangles) result.triangles.push_back(t + first);
  }
  return result;
}

class JoinParts : public testing::Test {
 protected:
  void SetUp() override {
    gltf_.document["materials"] = json::array();
    for (const char* const name : {"water", "oil"})
      gltf_.document["materials"].push_back(
          {{"name", name},
           {"pbrMetallicRoughness", {{"metallicFactor", 0.0}, {"roughnessFactor", 0.0}}},
           {"extensions",
            {{"KHR_materials_transmission", {{"transmissionFactor", 1.0}}},
             {"KHR_materials_volume", {{"thicknessFactor", 1.0}}}}}});
    gltf_.document["materials"].push_back({{"name", "steel"}});
    gltf_.document["extensionsUsed"] = {"KHR_materials_transmission", "KHR_materials_volume"};
    scene_ = json::parse(R"({
      "malus": 1, "name": "test", "origin": [0, 0, 0],
      "camera": {"position": [0, 1, 50], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"clear": {"type": "glass", "eta": 1.5}},
      "imports": [{"file": "model.gltf"}]})");
  }
  // Adds a mesh of one primitive per pair of geometry and material. Returns its index.
  int addMesh(const char* name, const std::vector<std::pair<prep::Mesh, int>>& primitives) {
    json list = json::array();
    for (const auto& [mesh, material] : primitives) {
      const int added = gltf_.addMesh(mesh, name, material);
      list.push_back(gltf_.document["meshes"][added]["primitives"][0]);
      gltf_.document["meshes"].erase(added);
    }
    return gltf_.add("meshes", {{"name", name}, {"primitives", list}});
  }
  Baked baked(const BakeOptions& options = {}) {
    folder_.write("model.gltf", gltf_.gltf());
    return bake(
        readSceneFile(folder_.write("scene.json", scene_.dump())), {}, [](std::string_view) {}, options);
  }
  std::string error() {
    return errorMessage([&] { baked(); });
  }
  static std::map<std::string, std::size_t> triangles(const Baked& baked) {
    std::map<std::string, std::size_t> counts;
    for (const pack::Mesh& mesh : baked.scene.meshes) counts[mesh.name] = mesh.triangles.size();
    return counts;
  }
  static std::size_t countNotes(const Baked& baked, std::string_view text) {
    return static_cast<std::size_t>(std::count_if(baked.notes.begin(), baked.notes.end(),
                                                  [&](const std::string& note) { return contains(note, text); }));
  }
  using Counts = std::map<std::string, std::size_t>;

  test::TemporaryFolder folder_;
  prep::test::GltfFile gltf_;
  json scene_;
};

TEST_F(JoinParts, PrimitivesOfOneBody) {
  const int mesh = addMesh("slab", {{sides({0, 1, 2}), 0}, {sides({3, 4, 5}), 0}});
  gltf_.addNode({{"name", "slab node"}, {"mesh", mesh}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"slab node", 12}}));
  EXPECT_EQ(countNotes(result, "joined primitives 0 and 1 of mesh 'slab'"), 1u);
  EXPECT_EQ(result.glassBodies.size(), 1u);
}

TEST_F(JoinParts, ThreePrimitivesBesideAnOpaqueOne) {
  // The first and the last primitive share no edge.
  const int mesh = addMesh("slab", {{sides({0}), 0}, {sides({4}), 2}, {sides({2, 3, 4, 5}), 0}, {sides({1}), 0}});
  gltf_.addNode({{"name", "slab"}, {"mesh", mesh}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"slab.1", 12}, {"slab.2", 2}}));
  EXPECT_EQ(countNotes(result, "primitives 0, 2 and 3"), 1u);
}

TEST_F(JoinParts, EachInstanceIsABody) {
  const int mesh = addMesh("slab", {{sides({0, 1, 2}), 0}, {sides({3, 4, 5}), 0}});
  gltf_.addNode({{"name", "a"}, {"mesh", mesh}});
  gltf_.addNode({{"name", "b"}, {"mesh", mesh}, {"translation", {3, 0, 0}}, {"scale", {-1, 1, 1}}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"a", 12}, {"b", 12}}));
  EXPECT_EQ(countNotes(result, "joined"), 1u);
  EXPECT_EQ(result.reports.size(), 1u);
}

TEST_F(JoinParts, MeshesOfOneBodyAtTheSamePlace) {
  const int left = addMesh("left", {{sides({0, 1, 2}), 0}}), right = addMesh("right", {{sides({3, 4, 5}), 0}});
  gltf_.addNode({{"name", "a"}, {"mesh", left}, {"translation", {3, 0, 0}}});
  gltf_.addNode({{"name", "b"}, {"mesh", right}, {"translation", {3, 0, 0}}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"a", 12}}));
  EXPECT_EQ(countNotes(result, "joined parts 'left' and 'right'"), 1u);
}

TEST_F(JoinParts, PiecesAtNodesWithDifferentTransforms) {
  // The right piece is stored beside its place, in its own axes.
  const int left = addMesh("left", {{sides({0, 1, 2}), 0}}),
            right = addMesh("right", {{sides({3, 4, 5}, {7, 1, 0}), 0}});
  const int steel = addMesh("steel", {{sides({0, 1, 2}), 2}});
  gltf_.addNode({{"name", "a"}, {"mesh", left}, {"translation", {3, 0, 0}}});
  gltf_.addNode({{"name", "b"}, {"mesh", right}, {"translation", {-4, -1, 0}}});
  gltf_.addNode({{"name", "c"}, {"mesh", steel}, {"translation", {9, 0, 0}}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"a", 12}, {"c", 6}}));
  EXPECT_EQ(countNotes(result, "joined parts 'a' and 'b': one body of material 'water'"), 1u);
  EXPECT_EQ(result.glassBodies.size(), 1u);
}

TEST_F(JoinParts, MirroredHalvesOfOneMesh) {
  // Half of a slab of 2 x 1 x 1 without the wall at x = 0, rotated so that positions are not exact.
  const int half = addMesh("half", {{sides({1, 2, 3, 4, 5}), 0}});
  for (int i = 0; i < 3; ++i) {
    const int a = gltf_.add("nodes", {{"mesh", half}, {"name", "right"}});
    const int b = gltf_.add("nodes", {{"mesh", half}, {"name", "left"}, {"scale", {-1, 1, 1}}});
    const int c = gltf_.add("nodes", {{"children", {b}}, {"rotation", {0.1, 0.2, 0.3, 0.9}}});
    const int d = gltf_.add("nodes", {{"children", {a}}, {"rotation", {0.1, 0.2, 0.3, 0.9}}});
    gltf_.addNode({{"children", {c, d}}, {"translation", {0.1, 5 * i, 0}}});
  }
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"left", 20}, {"left.2", 20}, {"left.3", 20}}));
  EXPECT_EQ(countNotes(result, "joined parts 'left' and 'right'"), 3u);
  EXPECT_EQ(result.glassBodies.size(), 3u);
}

TEST_F(JoinParts, PiecesApartAndOfTwoMaterialsStayApart) {
  const int left = addMesh("left", {{sides({0, 1, 2}), 0}}), right = addMesh("right", {{sides({3, 4, 5}), 0}});
  const int oil = addMesh("oil", {{sides({3, 4, 5}), 1}});
  gltf_.addNode({{"name", "a"}, {"mesh", left}});
  const int moved = gltf_.addNode({{"name", "b"}, {"mesh", right}, {"translation", {1e-5, 0, 0}}});
  EXPECT_CONTAINS(error(), "open edges");
  scene_["imports"][0]["weldTolerance"] = 1e-4;
  EXPECT_EQ(countNotes(baked(), "joined"), 1u);
  gltf_.document["nodes"][moved]["mesh"] = oil;
  EXPECT_CONTAINS(error(), "open edges");
}

TEST_F(JoinParts, SeamsWithinTheWeldTolerance) {
  const int mesh = addMesh("slab", {{sides({0, 1, 2}), 0}, {sides({3, 4, 5}, {1e-5, 0, 0}), 0}});
  gltf_.addNode({{"mesh", mesh}});
  EXPECT_CONTAINS(error(), "open edges");
  scene_["imports"][0]["weldTolerance"] = 1e-4;
  EXPECT_EQ(countNotes(baked(), "joined"), 1u);
}

TEST_F(JoinParts, ClosedPrimitivesStayApart) {
  const std::vector<int> all = {0, 1, 2, 3, 4, 5};
  const int mesh = addMesh("pair", {{sides(all), 0}, {sides(all, {3, 0, 0}), 0}});
  gltf_.addNode({{"name", "pair"}, {"mesh", mesh}});
  const Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"pair.1", 12}, {"pair.2", 12}}));
  EXPECT_EQ(countNotes(result, "joined"), 0u);
}

TEST_F(JoinParts, OpaqueAndOpenSurfacesStayApart) {
  const int mesh = addMesh("slab", {{sides({0, 1, 2}), 2}, {sides({3, 4, 5}), 2}});
  gltf_.addNode({{"name", "slab"}, {"mesh", mesh}});
  Baked result = baked();
  EXPECT_EQ(triangles(result), (Counts{{"slab.1", 6}, {"slab.2", 6}}));
  EXPECT_EQ(countNotes(result, "joined"), 0u);

  scene_["imports"][0]["materials"] = {{"steel", "clear"}};
  scene_["imports"][0]["openSurfaces"] = {"slab.1", "slab.2"};
  result = baked({.allowOpenGlass = true});
  EXPECT_EQ(triangles(result), (Counts{{"slab.1", 6}, {"slab.2", 6}}));
}

TEST_F(JoinParts, DifferentMaterialsAreAnErrorThatNamesThem) {
  const int mesh = addMesh("slab", {{sides({0, 1, 2}), 0}, {sides({3, 4, 5}), 1}});
  gltf_.addNode({{"mesh", mesh}});
  EXPECT_CONTAINS(error(), "spread over parts", "'slab.1'", "'water'", "'slab.2'", "'oil'", "'materials'");

  // The scene can give them one material.
  scene_["imports"][0]["materials"] = {{"water", "clear"}, {"oil", "clear"}};
  EXPECT_EQ(countNotes(baked(), "joined"), 1u);
}

TEST_F(JoinParts, GlassClosedByAnOpaquePartIsAnErrorThatNamesIt) {
  const int mesh = addMesh("mirror", {{sides({0, 1, 2, 3, 4}), 0}, {sides({5}), 2}});
  gltf_.addNode({{"mesh", mesh}});
  EXPECT_CONTAINS(error(), "spread over parts", "'steel'", "4 open edges");
}

TEST_F(JoinParts, ObjGroupsAndMaterials) {
  const std::string vertices = std::string(test::kCubeObj.substr(0, test::kCubeObj.find('f')));
  const auto write = [&](const std::string& first, const std::string& second) {
    folder_.write("model.obj", "mtllib model.mtl\n" + vertices + first + "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\n" + second +
                                   "f 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n");
  };
  folder_.write("model.mtl", "newmtl a\nd 0\nnewmtl b\nd 0\n");
  scene_["imports"][0] = {{"file", "model.obj"}};

  // Groups and objects of one material are one part.
  write("g front\nusemtl a\n", "g back\nusemtl a\n");
  EXPECT_EQ(triangles(baked()), (Counts{{"a", 12}}));
  write("o front\nusemtl a\n", "o back\n");
  EXPECT_EQ(triangles(baked()), (Counts{{"a", 12}}));

  // Two materials are joined only if the scene gives them one.
  write("usemtl a\n", "usemtl b\n");
  EXPECT_CONTAINS(error(), "spread over parts", "'a'", "'b'");
  scene_["imports"][0]["materials"] = {{"a", "clear"}, {"b", "clear"}};
  const Baked joined = baked();
  ASSERT_EQ(joined.scene.meshes.size(), 1u);
  EXPECT_EQ(joined.scene.meshes[0].triangles.size(), 12u);
  EXPECT_EQ(countNotes(joined, "joined parts 'a' and 'b'"), 1u);
}

}  // namespace
}  // namespace malus::bake
