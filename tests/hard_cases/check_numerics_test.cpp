// --check-numerics finds injected faults: the first unphysical value and the surface that it comes from.
#include <limits>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "render/scene/methods.h"
#include "render/vulkan/renderer.h"
#include "shaders/gpu/fault.h"
#include "shaders/optics/optics.h"
#include "tests/render/test_scene.h"

// The renderers' check, with Stokes vectors as payload.
#include "shaders/optics/language_begin.h"
#undef FN
#define FN  // members
namespace malus::f32 {
using namespace malus::gpu;
struct Checker {
  using Payload = Stokes;
  uint found = kNoFault;
  Stokes payloadStokes(const Payload& p, real3) { return p; }
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wunused-parameter"  // of effects that are off
#include "shaders/surfaces/hit.h"

#include "shaders/surfaces/check.h"
#include "shaders/surfaces/check_sent.h"
#pragma GCC diagnostic pop
  void noteFault(const Hit&, const vec4&, uint fault, uint, float) { found = fault; }
};
}  // namespace malus::f32
#include "shaders/optics/language_end.h"

namespace malus {
namespace {

using pack::MaterialKind;

// A gold floor that reflects an emitter in front of a dim sky.
pack::Scene lampOverGold(double radiance) {
  pack::Scene scene = test::emptyScene(3);
  scene.width = 40;
  scene.height = 30;
  scene.camera.verticalFovDegrees = 50;
  scene.environment.radiance = {0.1, 0.2, 0.3};
  pack::Material gold = test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9});
  gold.name = "gold";
  pack::Material lamp = test::emitter({1, radiance, 1});
  lamp.name = "lamp";
  test::addMaterial(scene, gold);
  test::addMaterial(scene, lamp);
  test::addSquare(scene, 0, {0, -1, 0}, {0, 1, 0}, 4);
  // Visible in the floor only: it is above the camera's field of view.
  test::addSquare(scene, 1, {0, 3, -6}, {0, -1, 0}, 1.5);
  test::look(scene, {0, 0.5, 4}, {0, -0.7, 0});
  return scene;
}

struct Found {
  std::string renderer;
  render::Faults faults;
};
std::vector<Found> everyRenderer(const pack::Scene& scene, const std::string& method) {
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.checkNumerics = true;
  std::vector<Found> list;
  list.push_back({"reference", reference::render(scene, parameters, 0).faults});
  list.push_back({"embree", embree::Renderer(scene, 0).render(method, parameters).faults});
  list.push_back({"vulkan", vulkan::Renderer(scene, {}).render(method, parameters).faults});
  return list;
}

TEST(CheckNumerics, ReportsTheSourceOfANan) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    const pack::Scene scene = lampOverGold(bad);
    std::uint32_t x = 0, y = 0;
    for (const std::string method : {"stokes", "fresnel", "sp", "importance"})
      for (const Found& found : everyRenderer(scene, method)) {
        SCOPED_TRACE(found.renderer + " " + method);
        ASSERT_GT(found.faults.count, 0u);
        ASSERT_TRUE(found.faults.first.has_value());
        const gpu::Fault& f = *found.faults.first;
        // The emitter, hit after one bounce on the floor, is reported, not the floor.
        EXPECT_EQ(f.kind, gpu::kNotFinite);
        EXPECT_EQ(f.material, 1u);
        EXPECT_EQ(f.bounce, 1);
        EXPECT_EQ(f.colour, 1u);
        EXPECT_NEAR(f.position.y, 3, 1e-5);
        // The first pixel in reading order, the same everywhere.
        if (found.renderer == "reference") {
          x = f.x;
          y = f.y;
          EXPECT_GT(y, 0u);
        }
        EXPECT_EQ(f.x, x);
        EXPECT_EQ(f.y, y);
        const std::string text = describe(found.faults, scene);
        for (const char* part : {"material 'lamp' (emitter)", "green", "is not finite", "bounce 1"})
          EXPECT_NE(text.find(part), std::string::npos) << text;
      }
  }
}

TEST(CheckNumerics, FindsNegativeLight) {
  for (const Found& found : everyRenderer(lampOverGold(-1), "stokes")) {
    SCOPED_TRACE(found.renderer);
    ASSERT_TRUE(found.faults.first.has_value());
    EXPECT_EQ(found.faults.first->kind, gpu::kNegative);
    EXPECT_EQ(found.faults.first->material, 1u);
  }
}

TEST(CheckNumerics, ReportsTheSurface) {
  pack::Scene scene = lampOverGold(1);
  scene.materials[0].k = glm::dvec3(std::numeric_limits<double>::quiet_NaN());
  for (const Found& found : everyRenderer(scene, "stokes")) {
    SCOPED_TRACE(found.renderer);
    ASSERT_TRUE(found.faults.first.has_value());
    EXPECT_EQ(found.faults.first->material, 0u) << "the metal, not the reflected surface";
    EXPECT_EQ(found.faults.first->bounce, 0);
  }
}

TEST(CheckNumerics, AcceptsRounding) {
  // slack: excess explained by the light that arrives at the surface.
  const auto classify = [](float s0, float s1, float s2, float s3, float slack) {
    f32::Checker checker;
    f32::Stokes s = f32::stokesUnpolarized(glm::vec3(s0));
    s.s1 = glm::vec3(s1);
    s.s2 = glm::vec3(s2);
    s.s3 = glm::vec3(s3);
    checker.checkSent(checker.environmentHit({0, 0, -1}, 0), s, glm::vec3(slack));
    return checker.found;
  };
  const float eps = std::numeric_limits<float>::epsilon(), infinity = std::numeric_limits<float>::infinity();
  EXPECT_EQ(classify(1, 1, 0, 0, 0), gpu::kNoFault);
  EXPECT_EQ(classify(1, 0, 0.6f, -0.8f, 0), gpu::kNoFault);
  EXPECT_EQ(classify(1, 1 + 3 * eps, 0, 0, 0), gpu::kNoFault);
  EXPECT_EQ(classify(1, 1 + 8 * eps, 0, 0, 0), gpu::kOverPolarized);
  EXPECT_EQ(classify(1, 0, 0.8f, -0.8f, 0), gpu::kOverPolarized);
  EXPECT_EQ(classify(1e30f, 2e30f, 0, 0, 0), gpu::kOverPolarized) << "no square overflows";
  EXPECT_EQ(classify(1e30f, 0, 0, 1e30f, 0), gpu::kNoFault);
  // Nearly extinct light has the rounding error of the brighter light that it comes from.
  EXPECT_EQ(classify(1e-9f, -2e-9f, 0, 0, 4 * eps * 0.1f), gpu::kNoFault);
  EXPECT_EQ(classify(-1e-9f, 0, 0, 0, 4 * eps * 0.1f), gpu::kNoFault);
  EXPECT_EQ(classify(-1e-6f, 0, 0, 0, 4 * eps * 0.1f), gpu::kNegative);
  EXPECT_EQ(classify(1, 0, infinity, 0, 0), gpu::kNotFinite);
  EXPECT_EQ(classify(std::numeric_limits<float>::quiet_NaN(), 0, 0, 0, 0), gpu::kNotFinite);
}

TEST(CheckNumerics, ReportsTheEnvironment) {
  pack::Scene scene = lampOverGold(1);
  scene.environment.radiance.z = std::numeric_limits<double>::infinity();
  for (const Found& found : everyRenderer(scene, "stokes-half")) {
    SCOPED_TRACE(found.renderer);
    // 16 bits saturate an infinity: there is no fault to find.
    if (found.renderer != "reference") {
      EXPECT_EQ(found.faults.count, 0u);
      continue;
    }
    ASSERT_TRUE(found.faults.first.has_value());
    EXPECT_EQ(found.faults.first->material, gpu::kEnvironment);
    EXPECT_NE(describe(found.faults, scene).find("the environment"), std::string::npos);
  }
}

TEST(CheckNumerics, ValidSceneHasNoFaults) {
  for (const std::string& method : render::methodNames())
    for (const Found& found : everyRenderer(lampOverGold(1), method)) {
      EXPECT_EQ(found.faults.count, 0u) << found.renderer << ' ' << method;
      EXPECT_FALSE(found.faults.first.has_value());
    }
}

TEST(CheckNumerics, DoesNotChangeTheImage) {
  const pack::Scene scene = lampOverGold(1);
  render::RenderParameters parameters = render::defaultParameters(scene);
  embree::Renderer embree(scene, 0);
  vulkan::Renderer vulkan(scene, {});
  const auto plain = embree.render("stokes", parameters).pixels,
             plainVulkan = vulkan.render("stokes", parameters).pixels;
  parameters.checkNumerics = true;
  EXPECT_EQ(embree.render("stokes", parameters).pixels, plain);
  EXPECT_EQ(vulkan.render("stokes", parameters).pixels, plainVulkan);
}

}  // namespace
}  // namespace malus
