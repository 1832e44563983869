// The paths of the Embree renderer: packets on every instruction set that this processor has, and one ray at a time.
// Both evaluate the same expressions, without contraction, so that images are nearly equal bit by bit: sums over the
// paths of a pixel, and roundings to 16 bits, may differ in their last digit.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <hwy/highway.h>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::embree {
namespace {

using render::EmbreePath;
using render::RenderParameters;
using render::RenderResult;

struct InstructionSet {
  const char* name;
  std::int64_t target;
};
constexpr InstructionSet kInstructionSets[] = {{"SSE4.2", HWY_SSE4}, {"AVX2", HWY_AVX2}, {"AVX-512", HWY_AVX3}};

// Limits the packets to one instruction set.
class Limited {
 public:
  explicit Limited(std::int64_t target) { hwy::SetSupportedTargetsForTest(target); }
  ~Limited() { hwy::SetSupportedTargetsForTest(0); }
  Limited(const Limited&) = delete;
  Limited& operator=(const Limited&) = delete;
};

RenderResult rendered(const pack::Scene& scene, const std::string& method, EmbreePath path, std::uint32_t samples = 1,
                      double tolerance = 0) {
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.embreePath = path;
  parameters.samples = samples;
  parameters.tolerance = tolerance;
  parameters.stokes = render::methodNamed(method).hasStokes;
  RenderResult result = Renderer(scene, 1).render(method, parameters);
  EXPECT_EQ(result.embreePath, path);
  return result;
}

void expectSame(const RenderResult& found, const RenderResult& expected, double most) {
  ASSERT_EQ(found.pixels.size(), expected.pixels.size());
  double largest = 0, difference = 0;
  for (std::size_t i = 0; i < expected.pixels.size(); ++i) {
    EXPECT_TRUE(std::isfinite(found.pixels[i]));
    largest = std::max(largest, static_cast<double>(std::abs(expected.pixels[i])));
    difference = std::max(difference, static_cast<double>(std::abs(found.pixels[i] - expected.pixels[i])));
  }
  EXPECT_GT(largest, 0.1);  // the image is not black
  EXPECT_LE(difference, most * largest);
  EXPECT_EQ(found.cost.rays, expected.cost.rays);
}

// stokes-half rounds to 16 bits at every surface.
double tolerance(const std::string& method) { return method == "stokes-half" ? 1e-3 : 1e-5; }

// On the instruction sets of this processor; prints those that it lacks.
void expectSameByBothPaths(const pack::Scene& scene, std::uint32_t samples) {
  std::vector<InstructionSet> sets;
  for (const InstructionSet& set : kInstructionSets)
    if ((hwy::SupportedTargets() & set.target) != 0)
      sets.push_back(set);
    else
      fmt::print("not tested: this processor lacks {}\n", set.name);
  ASSERT_FALSE(sets.empty());
  for (const render::MethodInfo& m : render::methods()) {
    const RenderResult expected = rendered(scene, m.name, EmbreePath::scalar, samples);
    for (const InstructionSet& set : sets) {
      SCOPED_TRACE(m.name + std::string(" on ") + set.name);
      const Limited limited(set.target);
      expectSame(rendered(scene, m.name, EmbreePath::packet, samples), expected, tolerance(m.name));
    }
  }
}

TEST(EmbreePaths, PacketsRenderTheImageOfSingleRays) { expectSameByBothPaths(test::mixedScene(), 1); }

TEST(EmbreePaths, PacketsRenderEveryEffect) { expectSameByBothPaths(test::everyEffectScene(), 2); }

// A rough wall and a rough floor. What the rays of their facets meet decides how much of their paths is computed.
pack::Scene roughScene(const glm::dvec3& environment, bool polarizedLight) {
  pack::Scene scene = test::everyEffectScene();
  scene.materials[0].roughness = 0.1;
  scene.environment.radiance = environment;
  if (!polarizedLight) {
    scene.materials[4].axis = glm::dvec3(0);
    scene.materials[4].polarization = 0;
    scene.environment.sun = glm::dvec3(0);
    scene.environment.skyDegree = 0;
  }
  return scene;
}

TEST(EmbreePaths, PacketsOfFacetsMeetEveryKindOfLight) {
  for (const glm::dvec3& environment : {glm::dvec3(0), glm::dvec3(0.2, 0.3, 0.5)})
    for (const bool polarizedLight : {false, true}) {
      SCOPED_TRACE(testing::Message() << environment.x << (polarizedLight ? " polarized" : " unpolarized"));
      const pack::Scene scene = roughScene(environment, polarizedLight);
      expectSameByBothPaths(scene, 1);
      for (const char* method : {"schlick-iterative", "importance"})
        expectSame(rendered(scene, method, EmbreePath::packet, 1, 0.02),
                   rendered(scene, method, EmbreePath::scalar, 1, 0.02), tolerance(method));
    }
}

// A pixel depends on its coordinates alone, not on the packet that it is traced in: on the light that is sampled and on
// the paths that end early, too.
void expectRegionIsPart(Renderer& renderer, const std::string& method, const RenderParameters& whole) {
  const RenderResult image = renderer.render(method, whole);
  RenderParameters part = whole;
  part.region = {3, 2, whole.width - 5, whole.height - 3};
  const RenderResult found = renderer.render(method, part);
  ASSERT_EQ(found.pixels.size(), std::size_t{part.region.width} * part.region.height * found.channels);
  for (std::size_t y = 0; y < part.region.height; ++y)
    for (std::size_t i = 0; i < part.region.width * found.channels; ++i)
      ASSERT_EQ(found.pixels[y * part.region.width * found.channels + i],
                image.pixels[((y + 2) * whole.width + 3) * image.channels + i])
          << method << " " << y << " " << i;
}

TEST(EmbreePaths, RegionsOfAnySizeAreParts) {
  for (const pack::Scene& scene : {test::mixedScene(), test::everyEffectScene()}) {
    Renderer renderer(scene, 2);
    RenderParameters whole = render::defaultParameters(scene);
    whole.tolerance = 0.1;
    for (const EmbreePath path : {EmbreePath::packet, EmbreePath::scalar})
      for (const render::MethodInfo& m : render::methods()) {
        whole.embreePath = path;
        whole.stokes = m.hasStokes;
        expectRegionIsPart(renderer, m.name, whole);
      }
  }
}

TEST(EmbreePaths, ChecksOfNumericsTakeSingleRays) {
  const pack::Scene scene = test::mixedScene();
  RenderParameters parameters = render::defaultParameters(scene);
  parameters.checkNumerics = true;
  EXPECT_EQ(Renderer(scene, 1).render("stokes", parameters).embreePath, EmbreePath::scalar);
}

}  // namespace
}  // namespace malus::embree
