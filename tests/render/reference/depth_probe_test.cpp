// Light beyond the depth against closed forms, and long paths on every method.
#include <cmath>

#include <gtest/gtest.h>

#include "bake/depth_probe.h"
#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/scene/methods.h"
#include "tests/bake/fixtures.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

// A glass plate 1 mm thick and 200 mm long, looked into at 40 degrees: 95 total reflections, out of the far end onto a
// lamp of radiance 1.
pack::Scene lightPipe(std::uint32_t depth) {
  pack::Scene scene = test::emptyScene(depth);
  scene.width = scene.height = 5;
  scene.camera.verticalFovDegrees = 0.2;
  test::look(scene, {0.084009963117728, 0.0003, 0.1}, {0.0001, 0.0003, 0});
  pack::Mesh pipe;
  pipe.name = "pipe";
  pipe.material = test::addMaterial(scene, test::dielectric(pack::MaterialKind::glass, 1.5));
  for (const float x : {-0.0005f, 0.0005f})
    for (const float y : {-0.01f, 0.01f})
      for (const float z : {-0.2f, 0.0f}) pipe.positions.emplace_back(x, y, z);
  pipe.triangles = {{0, 1, 3}, {0, 3, 2}, {4, 6, 7}, {4, 7, 5}, {0, 4, 5}, {0, 5, 1},
                    {2, 3, 7}, {2, 7, 6}, {0, 2, 6}, {0, 6, 4}, {1, 5, 7}, {1, 7, 3}};
  scene.meshes.push_back(std::move(pipe));
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {0.0035, -0.002, -0.201}, {0, 0, 1},
                  0.05);
  return scene;
}

// Means over s and p of (1 - R)^2 (first way) and of (1 - R)^2 / (1 - R^2) (all ways); R of an end at 40 degrees.
struct PipeLight {
  double first, all;
};
PipeLight pipeLight() {
  const double c1 = std::cos(40 * 3.14159265358979 / 180), s2 = std::sqrt(1 - c1 * c1) / 1.5,
               c2 = std::sqrt(1 - s2 * s2);
  const double rs = std::pow((c1 - 1.5 * c2) / (c1 + 1.5 * c2), 2), rp = std::pow((1.5 * c1 - c2) / (1.5 * c1 + c2), 2);
  return {((1 - rs) * (1 - rs) + (1 - rp) * (1 - rp)) / 2,
          ((1 - rs) * (1 - rs) / (1 - rs * rs) + (1 - rp) * (1 - rp) / (1 - rp * rp)) / 2};
}

TEST(DepthProbe, MeasuresTheLightBeyondADepth) {
  const pack::Scene scene = lightPipe(97);
  const bake::DepthProbe probe = reference::Renderer(scene, 0).probeDepth();
  const PipeLight light = pipeLight();
  EXPECT_GT(bake::shareBeyond(probe.beyond, 60), 0.99);
  EXPECT_NEAR(bake::shareBeyond(probe.beyond, 97), 1 - light.first / light.all, 2e-4);  // 0.29 %
  EXPECT_NEAR(bake::shareBeyond(probe.beyond, 255), 1 - light.first / light.all, 2e-4);
  EXPECT_LE(probe.rays, 1u << 20);
  // The same again, whatever the threads.
  EXPECT_EQ(reference::Renderer(scene, 1).probeDepth().beyond, probe.beyond);
}

// Panes of high indices have more paths of little light than a pixel has rays. Light with more than d interactions has
// entered, T = 1 - R, and was reflected d - 1 times inside.
TEST(DepthProbe, EstimatesTheLightOfPathsThatAreLeft) {
  for (const double eta : {30.0, 300.0, 1000.0}) {
    pack::Scene scene = test::emptyScene(64);
    scene.environment.radiance = glm::dvec3(1);
    test::addMaterial(scene, test::dielectric(pack::MaterialKind::glass, eta));
    test::addSquare(scene, 0, {0, 0.01, 0}, {0, 1, 0}, 4);
    test::addSquare(scene, 0, {0, -0.01, 0}, {0, -1, 0}, 4);
    scene.camera.verticalFovDegrees = 1;
    test::look(scene, {0, 1, 0}, {0, 0, 0}, {0, 0, -1});
    const std::vector<double> beyond = reference::Renderer(scene, 1).probeDepth().beyond;
    const double r = std::pow((eta - 1) / (eta + 1), 2);
    for (const std::uint32_t depth : {2u, 20u, 64u, 200u}) {
      const double expected = (1 - r) * std::pow(r, depth - 1);
      EXPECT_NEAR(bake::shareBeyond(beyond, depth), expected, 0.05 * expected + 1e-4) << eta << " " << depth;
    }
  }
}

TEST(DepthProbe, EndsWhereNoLightIsLost) {
  pack::Scene scene = test::emptyScene(1);
  scene.environment.radiance = glm::dvec3(1);
  EXPECT_TRUE(reference::Renderer(scene, 1).probeDepth().beyond.empty());
  test::look(scene, {0, 1, 1}, {0, 0, 0});
  test::addSquare(scene, test::addMaterial(scene, test::dielectric(pack::MaterialKind::mirrorGlass, 1.5)), {0, 0, 0},
                  {0, 1, 0}, 10);
  const std::vector<double> beyond = reference::Renderer(scene, 1).probeDepth().beyond;
  ASSERT_EQ(beyond.size(), 1u);  // all of it after one reflection
  EXPECT_NEAR(beyond[0], 1, 1e-12);
  scene.environment.radiance = glm::dvec3(0);
  EXPECT_TRUE(reference::Renderer(scene, 1).probeDepth().beyond.empty());
}

TEST(DepthProbe, ReportsLostLightAndTheDepthThatSuffices) {
  const std::vector<double> beyond = {1, 0.5, 0.25, 0.0005};
  EXPECT_CONTAINS(bake::lostLightNote(beyond, 1, "--depth"), "50 %");
  EXPECT_CONTAINS(bake::lostLightNote(beyond, 1, "--depth"), "--depth 3");
  EXPECT_EQ(bake::lostLightNote(beyond, 3, "--depth"), "");
  EXPECT_EQ(bake::lostLightNote(beyond, 200, "--depth"), "");
  EXPECT_EQ(bake::lostLightNote({}, 0, "--depth"), "");
  EXPECT_CONTAINS(bake::lostLightNote(std::vector<double>(256, 0.5), 255, "--depth"), "255");
}

TEST(DepthProbe, EmittersSeenFromBehindAreReportedOnce) {
  pack::Scene scene = test::emptyScene(2);
  test::look(scene, {0, 0, 5}, {0, 0, 0});
  const std::uint32_t lamp = test::addMaterial(scene, test::emitter(glm::dvec3(1)));
  test::addSquare(scene, lamp, {0, 0, 0}, {0, 0, -1}, 1);
  const bake::DepthProbe behind = reference::Renderer(scene, 1).probeDepth();
  EXPECT_EQ(behind.darkEmitters, std::vector<std::uint32_t>{lamp});
  EXPECT_EQ(bake::applyProbe(behind, scene).size(), 1u);
  scene.materials[lamp].twoSided = true;
  EXPECT_TRUE(reference::Renderer(scene, 1).probeDepth().darkEmitters.empty());
}

// By every method of Embree and by the reference, at depths above the earlier limit of 64.
TEST(LongPaths, LightPipeOfAHundredReflections) {
  const double expected = pipeLight().first;
  for (const std::uint32_t depth : {97u, 200u, 255u}) {
    const pack::Scene scene = lightPipe(depth);
    render::RenderParameters parameters = render::defaultParameters(scene);
    parameters.width = parameters.height = 1;
    parameters.region = {0, 0, 1, 1};
    EXPECT_NEAR(reference::render(scene, parameters, 1).pixels[1], expected, 1e-4);
    embree::Renderer embree(scene, 1);
    for (const render::MethodInfo& method : render::methods()) {
      const double found = embree.render(method.name, parameters).pixels[1];
      // Exact with polarization; otherwise the mean of R is applied twice, or Schlick's.
      EXPECT_NEAR(found, expected, method.accuracy == render::Accuracy::exact ? 2e-3 : 0.1) << method.name << depth;
    }
  }
}

TEST(Emitters, BothSidesRadiate) {
  for (const bool twoSided : {false, true})
    for (const double side : {1.0, -1.0}) {
      pack::Scene scene = test::emptyScene(1);
      test::look(scene, {0, 0, 5}, {0, 0, 0});
      const std::uint32_t lamp = test::addMaterial(scene, test::emitter({0.25, 0.5, 1}));
      scene.materials[lamp].twoSided = twoSided;
      scene.materials[lamp].albedo = glm::dvec3(0.7);  // of another kind of material
      test::addSquare(scene, lamp, {0, 0, 0}, {0, 0, side}, 1);
      const render::RenderParameters parameters = render::defaultParameters(scene);
      const float expected = side > 0 || twoSided ? 0.5f : 0.0f;
      EXPECT_EQ(reference::render(scene, parameters, 1).pixels[1], expected);
      for (const render::MethodInfo& method : render::methods())
        EXPECT_NEAR(embree::Renderer(scene, 1).render(method.name, parameters).pixels[1], expected, 1e-3)
            << method.name;
    }
}

}  // namespace
}  // namespace malus
