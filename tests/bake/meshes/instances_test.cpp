// Meshes that a scene or a model places several times are stored once.
#include "bake/meshes/instances.h"

#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "bake/bake.h"
#include "bake/bake_report.h"
#include "bake/info.h"
#include "bake/meshes/glass_bodies.h"
#include "bake/pack/reader.h"
#include "bake/pack/writer.h"
#include "bake/unpack.h"
#include "tests/bake/fixtures.h"

namespace malus::bake {
namespace {

using nlohmann::json;
using test::errorMessage;
using test::TemporaryFolder;

constexpr int kAround = 40, kRings = 20;
constexpr std::size_t kTriangles = 2 * kAround * (kRings - 1);

// A closed sphere of radius 0.5, facing outward.
std::string sphereObj() {
  std::string text = "v 0 0.5 0\n";
  for (int ring = 1; ring < kRings; ++ring)
    for (int i = 0; i < kAround; ++i) {
      const double theta = std::numbers::pi * ring / kRings, phi = 2 * std::numbers::pi * i / kAround;
      text += fmt::format("v {} {} {}\n", 0.5 * std::sin(theta) * std::cos(phi), 0.5 * std::cos(theta),
                          0.5 * std::sin(theta) * std::sin(phi));
    }
  text += "v 0 -0.5 0\n";
  const auto at = [](int ring, int i) { return 2 + (ring - 1) * kAround + i % kAround; };
  for (int i = 0; i < kAround; ++i) {
    text += fmt::format("f 1 {} {}\n", at(1, i + 1), at(1, i));
    text += fmt::format("f {} {} {}\n", 2 + (kRings - 1) * kAround, at(kRings - 1, i), at(kRings - 1, i + 1));
    for (int ring = 1; ring + 1 < kRings; ++ring) {
      text += fmt::format("f {} {} {}\n", at(ring, i), at(ring, i + 1), at(ring + 1, i));
      text += fmt::format("f {} {} {}\n", at(ring, i + 1), at(ring + 1, i + 1), at(ring + 1, i));
    }
  }
  return text;
}

class InstancesTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_.write("sphere.obj", sphereObj());
    folder_.write("cube.obj", test::kCubeObj);
    scene_ = json::parse(R"({
      "malus": 1, "name": "test",
      "camera": {"position": [0, 1, 50], "target": [0, 0, 0], "verticalFovDegrees": 30},
      "resolution": [64, 48], "depth": 4,
      "materials": {"gold": {"type": "metal", "preset": "gold"}, "glass": {"type": "glass", "eta": 1.5}},
      "meshes": []})");
  }
  void add(const char* name, const char* file, const char* material, const json& instances) {
    scene_["meshes"].push_back({{"name", name}, {"file", file}, {"material", material}, {"instances", instances}});
  }
  Baked baked() {
    return bake(readSceneFile(folder_.write("scene.json", scene_.dump())), {}, [](std::string_view) {}, {});
  }
  static pack::Pack packed(const Baked& baked) {
    pack::WriteSettings settings;
    settings.inspection = glassInspection(baked.scene, baked.glassBodies);
    return pack::parse(pack::serialize(baked.scene, settings).bytes, "test");
  }

  TemporaryFolder folder_;
  json scene_;
};

TEST_F(InstancesTest, AMeshIsStoredOnceAndPlacedByItsTransforms) {
  add("ball", "sphere.obj", "gold",
      {{{"translate", {0, 0, 0}}},
       {{"translate", {2, 0, 0}}, {"scale", {-1, 2, 1}}, {"rotateDegrees", {10, 20, 30}}},
       {{"translate", {-3, 1, 0}}, {"scale", 0.125}}});
  const Baked all = baked();
  const pack::Scene scene = packed(all).scene;
  ASSERT_EQ(scene.meshes.size(), 1u);
  ASSERT_EQ(scene.instances.size(), 2u);
  EXPECT_EQ(scene.meshes[0].name, "ball.1");
  EXPECT_EQ(scene.instances[0].name, "ball.2");
  EXPECT_EQ(scene.triangleCount(), kTriangles);
  EXPECT_EQ(pack::countInstances(scene).placedTriangles, 3 * kTriangles);
  ASSERT_EQ(all.choices.size(), 1u);
  EXPECT_CONTAINS(all.choices[0], "ball.1", "3 times", "once");

  // The places are those of the description: ellipsoids about the translations.
  const pack::Scene expanded = pack::withoutInstances(scene);
  const std::vector<glm::dvec3> centres = {{0, 0, 0}, {2, 0, 0}, {-3, 1, 0}},
                                radii = {{0.5, 0.5, 0.5}, {}, {0.0625, 0.0625, 0.0625}};
  for (std::size_t i : {0u, 2u})
    for (const glm::dvec3& p : expanded.meshes[i].positions)
      EXPECT_NEAR(glm::length(p + expanded.origin - centres[i]), radii[i].x, 1e-5);
  double least = 1, most = 0;
  for (const glm::dvec3& p : expanded.meshes[1].positions) {
    least = std::min(least, glm::length(p + expanded.origin - centres[1]));
    most = std::max(most, glm::length(p + expanded.origin - centres[1]));
  }
  EXPECT_NEAR(least, 0.5, 1e-2);
  EXPECT_NEAR(most, 1, 1e-2);
  // Mirrored or not, faces look away from the centre.
  for (std::size_t i = 0; i < 3; ++i)
    for (const glm::uvec3& t : expanded.meshes[i].triangles) {
      const auto& p = expanded.meshes[i].positions;
      EXPECT_GT(glm::dot(glm::cross(p[t.y] - p[t.x], p[t.z] - p[t.x]), p[t.x] + expanded.origin - centres[i]), 0);
    }
}

TEST_F(InstancesTest, SmallMeshesAreCopied) {
  add("cube", "cube.obj", "gold", {{{"translate", {0, 0, 0}}}, {{"translate", {3, 0, 0}}}});
  const Baked all = baked();
  EXPECT_EQ(all.scene.meshes.size(), 2u);
  EXPECT_TRUE(all.scene.instances.empty());
  EXPECT_TRUE(all.choices.empty());
  for (const pack::Section& section : packed(all).sections) EXPECT_NE(section.id, pack::kInstances);
}

TEST_F(InstancesTest, PlacesThatShareAPositionAreMeshes) {
  // The first two touch at their poles.
  add("ball", "sphere.obj", "gold",
      {{{"translate", {0, 0, 0}}}, {{"translate", {0, 1, 0}}}, {{"translate", {3, 0, 0}}}, {{"translate", {5, 0, 0}}}});
  const Baked all = baked();
  EXPECT_EQ(all.scene.meshes.size(), 3u);
  ASSERT_EQ(all.scene.instances.size(), 1u);
  EXPECT_EQ(all.scene.instances[0].name, "ball.4");
  EXPECT_EQ(all.scene.meshes[all.scene.instances[0].mesh].name, "ball.3");
  ASSERT_EQ(all.choices.size(), 1u);
  EXPECT_CONTAINS(all.choices[0], "4 times", "3 times", "positions that other meshes share (2)");
}

TEST_F(InstancesTest, GlassBesideGlassIsInspectedByItself) {
  const json places = {{{"translate", {0, 0, 0}}},
                       {{"translate", {0.9, 0.9, 0}}},
                       {{"translate", {5, 0, 0}}},
                       {{"translate", {8, 0, 0}}}};
  add("ball", "sphere.obj", "glass", places);
  const Baked all = baked();
  EXPECT_TRUE(all.notes.empty());
  EXPECT_EQ(all.scene.meshes.size(), 3u);
  EXPECT_EQ(all.glassBodies.size(), 3u);
  ASSERT_EQ(all.choices.size(), 1u);
  EXPECT_CONTAINS(all.choices[0], "glass beside other glass (2)");
  // Bodies that cross are reported as without instances.
  scene_["meshes"][0]["instances"][1]["translate"] = {0.3, 0.3, 0};
  ASSERT_EQ(baked().notes.size(), 1u);
  EXPECT_CONTAINS(baked().notes[0], "ball.1", "ball.2", "touch or cross");
  scene_["meshes"][0]["instances"][3]["translate"] = {5, 0, 0};
  EXPECT_CONTAINS(errorMessage([&] { baked(); }), "same body");
}

TEST_F(InstancesTest, ThinTransformsAreMeshes) {
  add("ball", "sphere.obj", "gold",
      {{{"translate", {0, 0, 0}}}, {{"translate", {3, 0, 0}}}, {{"translate", {6, 0, 0}}, {"scale", {1, 1, 1e-4}}}});
  const Baked all = baked();
  EXPECT_EQ(all.scene.meshes.size(), 2u);
  EXPECT_EQ(all.scene.instances.size(), 1u);
  EXPECT_CONTAINS(all.choices.at(0), "1:1000");
}

TEST_F(InstancesTest, CoincidentFacesOfInstancesAreReported) {
  // A pane of glass on the flat side of a cube cannot be seen from one side; the cube is small, the ball has instances.
  add("ball", "sphere.obj", "glass", {{{"translate", {0, 0, 0}}}, {{"translate", {30, 0, 0}}}});
  add("other", "sphere.obj", "gold", {{{"translate", {30, 0, 0}}}});
  const Baked all = baked();
  EXPECT_EQ(all.scene.instances.size(), 0u);  // shared positions
  ASSERT_EQ(all.notes.size(), 1u);
  EXPECT_CONTAINS(all.notes[0], "ball.2", "other", "coincide");
}

TEST_F(InstancesTest, FarPlacesKeepTheirShape) {
  scene_["origin"] = {0, 0, 0};
  add("ball", "sphere.obj", "gold", {{{"translate", {1e5, 0, 1e5}}}, {{"translate", {-1e5, 7, 0.1}}}});
  const pack::Scene scene = packed(baked()).scene;
  ASSERT_EQ(scene.instances.size(), 1u);
  const glm::dvec3 centre(-1e5, 7, 0.1);
  for (const glm::dvec3& p : scene.meshes[0].positions)
    EXPECT_NEAR(glm::length(pack::placedPoint(scene.instances[0], p) - centre), 0.5, 1e-4);
}

TEST_F(InstancesTest, ReportsStateBothCounts) {
  json places = json::array();
  for (int i = 0; i < 20; ++i) places.push_back({{"translate", {2 * i, 0, 0}}});
  add("ball", "sphere.obj", "gold", places);
  const Baked all = baked();
  const pack::Written written = pack::serialize(all.scene, {});
  const std::string counts = fmt::format("{} triangles stored, {} placed in 20 instances", kTriangles, 20 * kTriangles);
  EXPECT_CONTAINS(bakeText(all, written, "out.pack", false), counts);
  const json report = bakeJson(all, written, "out.pack");
  EXPECT_EQ(report["triangles"], kTriangles);
  EXPECT_EQ(report["placedTriangles"], 20 * kTriangles);
  EXPECT_EQ(report["instances"], 20);
  const pack::Pack pack = pack::parse(written.bytes, "test");
  EXPECT_CONTAINS(infoText(pack, 0.01), counts, "placed 20 times");
  EXPECT_EQ(infoJson(pack, 0.01)["placedTriangles"], 20 * kTriangles);
  EXPECT_EQ(infoJson(pack, 0.01)["meshes"][0]["placements"], 20);

  // unpack writes the mesh once, and the instances.
  const json document = unpack(pack, folder_.path() / "unpacked");
  EXPECT_EQ(document["meshes"].size(), 1u);
  ASSERT_EQ(document["instances"].size(), 19u);
  EXPECT_EQ(document["instances"][0]["mesh"], "ball.1");
  EXPECT_EQ(document["instances"][4]["linear"]["x"], json({1.0, 0.0, 0.0}));
  EXPECT_EQ(document["instances"][4]["translation"], json({10.0, 0.0, 0.0}));
}

}  // namespace
}  // namespace malus::bake
