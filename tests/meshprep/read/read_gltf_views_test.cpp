// Cameras, lights (KHR_lights_punctual) and the description of content that is left out.
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "tests/meshprep/read/gltf_reading.h"

namespace malus::prep::test {
namespace {

using nlohmann::json;

constexpr double kPi = std::numbers::pi;

json perspective(double yfov) { return {{"type", "perspective"}, {"perspective", {{"yfov", yfov}, {"znear", 0.1}}}}; }

json lightAt(int index) { return {{"KHR_lights_punctual", {{"light", index}}}}; }

// A triangle, and a list of lights.
GltfFile fileWithLights(json lights) {
  GltfFile gltf = triangleFile();
  gltf.document["extensionsUsed"] = {"KHR_lights_punctual"};
  gltf.document["extensions"] = {{"KHR_lights_punctual", {{"lights", std::move(lights)}}}};
  return gltf;
}

void expectNear(const glm::dvec3& found, const glm::dvec3& expected) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(found[i], expected[i], 1e-12);
}

TEST(ReadGltfViews, PlacesCameras) {
  GltfFile gltf = triangleFile();
  gltf.add("cameras", perspective(0.5));
  gltf.document["cameras"][0]["name"] = "lens";
  gltf.document["cameras"][0]["perspective"]["aspectRatio"] = 1.5;
  gltf.add("cameras",
           {{"type", "orthographic"}, {"orthographic", {{"xmag", 3}, {"ymag", 2}, {"znear", 0}, {"zfar", 9}}}});
  // By 90 degrees about +y: looks toward -x. The scale does not matter.
  const double half = std::sqrt(0.5);
  const int child = gltf.add("nodes", {{"name", "side"}, {"camera", 0}, {"rotation", {0, half, 0, half}}});
  gltf.addNode({{"children", {child}}, {"translation", {1, 2, 3}}, {"scale", {2, 5, 0.5}}});
  gltf.addNode({{"camera", 1}});
  const SourceScene scene = readGlb(gltf);
  ASSERT_EQ(scene.cameras.size(), 2u);
  const SourceCamera &side = scene.cameras[0], &flat = scene.cameras[1];
  EXPECT_EQ(side.name, "side");
  EXPECT_EQ(side.objectName, "lens");
  expectNear(side.position, {1, 2, 3});
  expectNear(side.forward, {-1, 0, 0});
  expectNear(side.up, {0, 1, 0});
  EXPECT_FALSE(side.isOrthographic);
  EXPECT_EQ(side.verticalFov, 0.5);
  EXPECT_EQ(side.aspect, 1.5);
  EXPECT_EQ(flat.name, "node 3");
  EXPECT_TRUE(flat.isOrthographic);
  EXPECT_EQ(flat.height, 4);
  EXPECT_EQ(flat.aspect, 1.5);
  EXPECT_TRUE(scene.notes.empty());
}

TEST(ReadGltfViews, LeavesOutInvalidCameras) {
  const auto readLightNote = [](const json& camera, const json& node = {{"camera", 0}}) {
    GltfFile gltf = triangleFile();
    gltf.add("cameras", camera);
    gltf.addNode(node);
    const SourceScene scene = readGlb(gltf);
    EXPECT_TRUE(scene.cameras.empty());
    EXPECT_EQ(scene.parts.size(), 1u);
    return scene.notes.empty() ? std::string() : scene.notes[0];
  };
  EXPECT_CONTAINS(readLightNote(perspective(0)), "cameras[0].perspective.yfov", "out of range");
  EXPECT_CONTAINS(readLightNote(perspective(kPi)), "yfov");
  EXPECT_CONTAINS(readLightNote({{"type", "fisheye"}}), "cameras[0].type", "'fisheye'", "orthographic");
  EXPECT_CONTAINS(readLightNote({{"type", "orthographic"}, {"orthographic", {{"xmag", 1}, {"ymag", 0}}}}), "ymag");
  EXPECT_CONTAINS(readLightNote(json::object()), "cameras[0].type", "missing");
  EXPECT_CONTAINS(readLightNote({{"type", "perspective"}, {"perspective", {{"yfov", "wide"}}}}), "yfov", "a number");
  EXPECT_CONTAINS(readLightNote(perspective(1), {{"camera", 4}}), "cameras", "below 1");
  EXPECT_CONTAINS(readLightNote(perspective(1), {{"camera", 0}, {"scale", {1, 1, 0}}}), "singular");
  GltfFile unplaced = triangleFile();
  unplaced.add("cameras", perspective(1));
  EXPECT_TRUE(hasNote(readGlb(unplaced), "cameras without a node (1)"));
}

TEST(ReadGltfViews, PlacesLights) {
  GltfFile gltf = fileWithLights({{{"type", "point"}, {"color", {1, 0.5, 0}}, {"intensity", 40}, {"range", 9}},
                                  {{"type", "spot"}, {"spot", {{"innerConeAngle", 0.25}}}},
                                  {{"type", "directional"}, {"intensity", 3}}});
  gltf.addNode({{"name", "bulb"}, {"extensions", lightAt(0)}, {"translation", {4, 5, 6}}});
  gltf.addNode({{"extensions", lightAt(1)}, {"rotation", {-std::sqrt(0.5), 0, 0, std::sqrt(0.5)}}});
  gltf.addNode({{"extensions", lightAt(2)}, {"scale", {3, 3, 3}}});
  const SourceScene scene = readGlb(gltf);
  ASSERT_EQ(scene.lights.size(), 3u);
  const SourceLight &bulb = scene.lights[0], &spot = scene.lights[1], &sun = scene.lights[2];
  EXPECT_EQ(bulb.kind, SourceLight::Kind::point);
  EXPECT_EQ(bulb.name, "bulb");
  EXPECT_EQ(bulb.position, glm::dvec3(4, 5, 6));
  EXPECT_EQ(bulb.intensity, glm::dvec3(40, 20, 0));
  EXPECT_EQ(spot.kind, SourceLight::Kind::spot);
  expectNear(spot.direction, {0, -1, 0});
  EXPECT_EQ(spot.innerConeAngle, 0.25);
  EXPECT_EQ(spot.outerConeAngle, kPi / 4);
  EXPECT_EQ(spot.intensity, glm::dvec3(1));
  EXPECT_EQ(sun.kind, SourceLight::Kind::directional);
  expectNear(sun.direction, {0, 0, -1});
  EXPECT_EQ(sun.intensity, glm::dvec3(3));
  ASSERT_EQ(scene.notes.size(), 1u);
  EXPECT_CONTAINS(scene.notes[0], "ranges of lights (1");
}

TEST(ReadGltfViews, LeavesOutInvalidLights) {
  const auto readLightNote = [](const json& light) {
    GltfFile gltf = fileWithLights({light});
    gltf.addNode({{"extensions", lightAt(0)}});
    const SourceScene scene = readGlb(gltf);
    EXPECT_TRUE(scene.lights.empty());
    return scene.notes.empty() ? std::string() : scene.notes[0];
  };
  EXPECT_CONTAINS(readLightNote({{"type", "area"}}), "lights[0].type", "'area'");
  EXPECT_CONTAINS(readLightNote({{"type", "point"}, {"intensity", -1}}), "intensity", "range");
  EXPECT_CONTAINS(readLightNote({{"type", "spot"}, {"spot", {{"outerConeAngle", 2}}}}), "cone angles");
  EXPECT_CONTAINS(readLightNote({{"type", "spot"}, {"spot", {{"innerConeAngle", 1}}}}), "cone angles");
  EXPECT_CONTAINS(readLightNote(json::object()), "lights[0].type", "missing");
}

TEST(ReadGltfViews, CountsContentThatIsLeftOut) {
  GltfFile gltf = triangleFile();
  gltf.document["animations"] = {
      {{"name", "walk"}, {"channels", {{{"name", "inner"}}}}}, {{"name", "run"}}, {{"x", 1}}};
  for (int i = 0; i < 12; ++i) gltf.add("gizmos", {{"name", "gizmo" + std::to_string(i)}});
  const SourceScene scene = readGlb(gltf);
  EXPECT_TRUE(hasNote(scene, "animations (3: 'walk', 'run'; the default pose is used)"));
  EXPECT_TRUE(hasNote(scene, "key 'gizmos' (12: 'gizmo0', "));
  EXPECT_TRUE(hasNote(scene, "'gizmo7', ...)"));
}

}  // namespace
}  // namespace malus::prep::test
