// Coverage against the renderers: a surface that reflects and emits nothing, in a white environment, is black exactly
// where it covers the image.
#include "render/embree/coverage.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

#include "render/embree/renderer.h"
#include "render/reference/renderer.h"
#include "tests/render/test_scene.h"

namespace malus::embree {
namespace {

// Black squares in front of a white environment: one in the middle, one oblique.
pack::Scene squares() {
  pack::Scene scene = test::emptyScene(2);
  scene.width = 61;  // not a multiple of a packet
  scene.height = 40;
  scene.camera.verticalFovDegrees = 40;
  scene.environment.radiance = {1, 1, 1};
  test::addMaterial(scene, test::emitter({0, 0, 0}));
  test::addSquare(scene, 0, {0, 0, 0}, {0, 0, 1}, 0.4);
  test::addSquare(scene, 0, {1, 0.3, -1}, {0.9, 0.2, 0.4}, 0.5);
  test::look(scene, {0, 0, 3}, {0, 0, 0});
  return scene;
}

void expectBlackWhereCovered(const pack::Scene& scene, const render::RenderParameters& parameters) {
  const std::vector<float> covered = coverage(scene, parameters, 0);
  const render::RenderResult image = Renderer(scene, 0).render("fresnel", parameters);
  const render::RenderResult exact = reference::Renderer(scene, 0).render("", parameters);
  ASSERT_EQ(covered.size(), std::size_t{image.width} * image.height);
  for (std::size_t i = 0; i < covered.size(); ++i) {
    EXPECT_NEAR(covered[i], 1 - image.pixels[i * image.channels], 1e-6) << i;
    EXPECT_NEAR(covered[i], 1 - exact.pixels[i * exact.channels], 1e-6) << i;
  }
  // Pixels of each kind, so that the comparison means something.
  EXPECT_GT(std::count(covered.begin(), covered.end(), 0.0f), 10);
  EXPECT_GT(std::count(covered.begin(), covered.end(), 1.0f), 10);
}

TEST(Coverage, IsBlackInRendersOfBlackSurfaces) {
  const pack::Scene scene = squares();
  for (const std::uint32_t samples : {1u, 3u}) {
    render::RenderParameters parameters = render::defaultParameters(scene);
    parameters.samples = samples;
    expectBlackWhereCovered(scene, parameters);
    const std::vector<float> all = coverage(scene, parameters, 1);
    EXPECT_EQ(std::any_of(all.begin(), all.end(), [](float a) { return a > 0 && a < 1; }), samples > 1);
    EXPECT_EQ(all, coverage(scene, parameters, 2));
  }
}

TEST(Coverage, OfOrthographicCameras) {
  pack::Scene scene = squares();
  scene.camera.orthographicHeight = 2;
  render::RenderParameters parameters = render::defaultParameters(scene);
  expectBlackWhereCovered(scene, parameters);
  // The square in the middle covers 0.8 of the height, and the width of the image is 61 / 40 of it.
  parameters.samples = 8;
  scene.meshes.pop_back();
  const std::vector<float> covered = coverage(scene, parameters, 0);
  const double area = std::accumulate(covered.begin(), covered.end(), 0.0) / static_cast<double>(covered.size());
  EXPECT_NEAR(area, 0.4 * 0.4 / (61.0 / 40), 1e-6);
}

TEST(Coverage, OfARegionIsThatOfTheImage) {
  const pack::Scene scene = squares();
  render::RenderParameters parameters = render::defaultParameters(scene);
  const std::vector<float> whole = coverage(scene, parameters, 0);
  parameters.region = {7, 5, 30, 20};
  const std::vector<float> part = coverage(scene, parameters, 0);
  ASSERT_EQ(part.size(), 600u);
  for (std::size_t y = 0; y < 20; ++y)
    for (std::size_t x = 0; x < 30; ++x) EXPECT_EQ(part[30 * y + x], whole[61 * (y + 5) + x + 7]);
}

TEST(Coverage, CountsGlass) {
  pack::Scene scene = squares();
  scene.materials[0] = test::dielectric(pack::MaterialKind::thinGlass, 1.5);
  const render::RenderParameters parameters = render::defaultParameters(scene);
  EXPECT_EQ(coverage(scene, parameters, 0), coverage(squares(), parameters, 0));
}

}  // namespace
}  // namespace malus::embree
