#include "bake/meshes/glass_bodies.h"

#include <algorithm>
#include <string>

#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::errorMessage;
using test::TemporaryFolder;

// Scenes of cubes of glass of side 1, one mesh per cube.
class GlassBodiesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("cube.obj", test::kCubeObj);
    scene_ = json::parse(R"({
      "malus": 1, "name": "test",
      "camera": {"position": [0, 1, 5], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"glass": {"type": "glass", "eta": 1.5}, "water": {"type": "glass", "eta": 1.33, "outsideEta": 1.5}},
      "meshes": []})");
  }
  void add(const char* name, const json& translate, double scale = 1, const char* material = "glass") {
    scene_["meshes"].push_back({{"name", name},
                                {"file", "cube.obj"},
                                {"material", material},
                                {"instances", {{{"translate", translate}, {"scale", scale}}}}});
  }
  Baked baked(bool allowed = false) {
    return bake(readSceneFile(folder_.write("scene.json", scene_.dump())), {}, [](std::string_view) {}, {allowed});
  }
  static pack::Written written(const Baked& baked, std::optional<int> bits = {}) {
    pack::WriteSettings settings;
    settings.bounds.positionBits = bits;
    settings.inspection = glassInspection(baked.scene, baked.glassBodies);
    return pack::serialize(baked.scene, settings);
  }

  TemporaryFolder folder_;
  json scene_;
};

TEST_F(GlassBodiesTest, NarrowGapsGetMoreBits) {
  add("a", {0, 0, 0});
  add("b", {1 + 3e-7, 0.25, 0});
  const Baked both = baked();
  EXPECT_TRUE(both.notes.empty());
  EXPECT_EQ(both.glassBodies.size(), 2u);
  EXPECT_GT(written(both).positionBits, 20);
  const std::string error = errorMessage([&] { written(both, 12); });
  EXPECT_CONTAINS(error, "mesh 'a'", "mesh 'b'", "12 position bits", " m apart");
}

TEST_F(GlassBodiesTest, TouchingBodiesAreAWarning) {
  add("a", {0, 0, 0});
  add("b", {1, 0.25, 0});
  const Baked both = baked();
  ASSERT_EQ(both.notes.size(), 1u);
  EXPECT_CONTAINS(both.notes[0], "'a'", "'b'", "touch");
  EXPECT_EQ(errorMessage([&] { written(both); }), "");
}

TEST_F(GlassBodiesTest, ABodyGivenTwiceIsRefused) {
  add("a", {0, 0, 0});
  add("b", {0, 0, 0});
  EXPECT_CONTAINS(errorMessage([&] { baked(); }), "'a'", "'b'", "same body");
  EXPECT_EQ(baked(true).notes.size(), 1u);
}

TEST_F(GlassBodiesTest, NestedBodiesNeedTheIndexAroundThem) {
  add("a", {0, 0, 0});
  add("b", {0, 0, 0}, 0.5);
  EXPECT_CONTAINS(errorMessage([&] { baked(); }), "'b' is inside mesh 'a'", "outsideEta", "1.5");
  scene_["meshes"][1]["material"] = "water";
  EXPECT_TRUE(baked().notes.empty());
}

TEST_F(GlassBodiesTest, CopiesAreInspectedOnce) {
  // Copies on the grid have one shape; a rotated one has another.
  for (int i = 0; i < 20; ++i) add(("copy" + std::to_string(i)).c_str(), {2 * i, 0, 0});
  add("turned", {0, 8, 0});
  scene_["meshes"].back()["instances"][0]["rotateDegrees"] = {10, 20, 30};
  const Baked all = baked();
  ContactsWithin within;
  const auto positions = [&](std::size_t i) -> const std::vector<glm::dvec3>& { return all.scene.meshes[i].positions; };
  EXPECT_TRUE(within.find(all.scene, all.glassBodies, positions).empty());
  EXPECT_EQ(within.inspectedShapes(), 2u);
  EXPECT_TRUE(findContactsBetween(all.scene, all.glassBodies, positions).found.empty());
}

TEST_F(GlassBodiesTest, FoldedCopiesAreAllReported) {
  // Two copies of a cube, of which a vertex is moved through the opposite face.
  add("a", {0, 0, 0});
  add("b", {4, 0, 0});
  Baked both = baked();
  for (pack::Mesh& mesh : both.scene.meshes)
    for (glm::dvec3& p : mesh.positions)
      if (p == mesh.positions.front()) p.x += 3;
  ContactsWithin within;
  const std::vector<Contact> contacts =
      within.find(both.scene, both.glassBodies,
                  [&](std::size_t i) -> const std::vector<glm::dvec3>& { return both.scene.meshes[i].positions; });
  EXPECT_EQ(within.inspectedShapes(), 1u);
  const auto ofMesh = [&](std::size_t i) {
    return std::count_if(contacts.begin(), contacts.end(), [&](const Contact& c) { return c.mesh[0] == i; });
  };
  EXPECT_GT(ofMesh(0), 0);
  EXPECT_EQ(ofMesh(0), ofMesh(1));
  EXPECT_NEAR(contacts.back().at.x - contacts.front().at.x, 4, 1);
}

TEST_F(GlassBodiesTest, ContactsAreFoundAmongManyBodies) {
  // One long body crosses 20 others: more regions than are compared one by one.
  for (int i = 0; i < 20; ++i) add(("copy" + std::to_string(i)).c_str(), {2 * i, 0, 0});
  add("rod", {19.05, 0, 0});
  scene_["meshes"].back()["instances"][0]["scale"] = {45, 0.3, 0.3};
  const Baked all = baked();
  EXPECT_EQ(all.notes.size(), 20u);
  EXPECT_EQ(errorMessage([&] { written(all); }), "");
}

// Squares of side 1, facing up, on or near the top of the cube at y = 0.5.
TEST_F(GlassBodiesTest, OpaqueFacesInFacesOfGlassAreAWarning) {
  folder_.write("square.obj", test::kSquareObj);
  scene_["materials"]["paper"] = {{"type", "lambert"}, {"albedo", {1, 1, 1}}};
  add("bottle", {0, 0, 0});
  const auto label = [&](const json& instance) {
    while (scene_["meshes"].size() > 1) scene_["meshes"].erase(1);
    scene_["meshes"].push_back(
        {{"name", "label"}, {"file", "square.obj"}, {"material", "paper"}, {"instances", {instance}}});
    return baked().notes;
  };
  for (const json& placed :
       {json{{"translate", {0, 0.5, 0}}}, json{{"translate", {0.1, 0.5, -0.2}}, {"scale", 0.3}},
        json{{"translate", {0.3, 0.5, 0}}, {"rotateDegrees", {0, 30, 0}}}, json{{"translate", {0, -0.5, 0}}},
        json{{"translate", {0, 0.5 + 1e-8, 0}}}, json{{"translate", {0, 0.5 + 4e-7, 0}}},
        json{{"translate", {0, 0.5 - 4e-7, 0}}}, json{{"translate", {2, 0.5, 1}}, {"scale", 20}}}) {
    const std::vector<std::string> notes = label(placed);
    ASSERT_EQ(notes.size(), 1u) << placed;
    EXPECT_CONTAINS(notes[0], "'label'", "'bottle'", "apart");
  }
  EXPECT_CONTAINS(label({{"translate", {0, 0.5, 0}}})[0], "pairs");
  // Apart, beside each other, through each other, and from an edge upward.
  for (const json& placed :
       {json{{"translate", {0, 0.501, 0}}}, json{{"translate", {0, 0.5 + 3e-6, 0}}}, json{{"translate", {1, 0.5, 0}}},
        json{{"translate", {0, 0.25, 0}}}, json{{"translate", {0.5, 1, 0}}, {"rotateDegrees", {0, 0, 90}}},
        json{{"translate", {0, 0.5, 0}}, {"rotateDegrees", {1, 0, 0}}}})
    EXPECT_TRUE(label(placed).empty()) << placed;
}

}  // namespace
}  // namespace malus::bake
