#include "bake/meshes/glass_bodies.h"

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

}  // namespace
}  // namespace malus::bake
