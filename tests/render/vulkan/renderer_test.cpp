#include "render/vulkan/renderer.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "tests/render/test_scene.h"

namespace malus::vulkan {
namespace {

using pack::MaterialKind;

// A paint floor, a glass pane, a metal wall, a lambert wall, an emitter and a point light.
pack::Scene makeScene() {
  pack::Scene scene = test::emptyScene(4);
  scene.width = 48;
  scene.height = 32;
  scene.camera.verticalFovDegrees = 50;
  scene.environment.radiance = {0.2, 0.3, 0.5};
  scene.environment.ambientIrradiance = 0.5;
  scene.environment.irradiance[0] = {0.6, 0.9, 1.5};
  pack::Material paint = test::dielectric(MaterialKind::paint, 1.5, 0.6);
  paint.highlightStrength = 1;
  paint.highlightExponent = 100;
  pack::Material lambert;
  lambert.albedo = {0.7, 0.2, 0.1};
  const auto floor = test::addMaterial(scene, paint);
  const auto glass = test::addMaterial(scene, test::dielectric(MaterialKind::glass, 1.5));
  const auto gold = test::addMaterial(scene, test::metal({0.18, 0.54, 1.33}, {3.4, 2.2, 1.9}));
  const auto wall = test::addMaterial(scene, lambert);
  const auto lamp = test::addMaterial(scene, test::emitter({5, 5, 5}));
  test::addSquare(scene, floor, {0, -1, 0}, {0, 1, 0}, 3);
  test::addSquare(scene, glass, {0.4, 0, 0.5}, {0, 0, 1}, 0.8);
  test::addSquare(scene, glass, {0.4, 0, 0.45}, {0, 0, -1}, 0.8);
  test::addSquare(scene, gold, {-2, 0, 0}, {1, 0, 0.4}, 1.5);
  test::addSquare(scene, wall, {0, 0, -3}, {0, 0, 1}, 3);
  test::addSquare(scene, lamp, {1, 2, 0}, {0, -1, 0}, 0.5);
  scene.lights.push_back({{1, 1.5, 2}, {6, 6, 6}});
  test::look(scene, {0.5, 0.5, 4}, {0, -0.2, 0});
  return scene;
}

TEST(VulkanRenderer, EqualsEmbreeInEveryMethod) {
  const pack::Scene scene = makeScene();
  const render::RenderParameters parameters = render::defaultParameters(scene);
  Renderer renderer(scene, {});
  embree::Renderer other(scene, 0);
  std::uint64_t rays = 0;
  for (const std::string& method : render::methodNames()) {
    const render::RenderResult a = renderer.render(method, parameters), b = other.render(method, parameters);
    ASSERT_EQ(a.pixels.size(), b.pixels.size()) << method;
    std::size_t outliers = 0;
    double sum = 0;
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
      ASSERT_TRUE(std::isfinite(a.pixels[i])) << method;
      sum += b.pixels[i];
      if (std::abs(a.pixels[i] - b.pixels[i]) > 1e-4f * (1 + std::abs(b.pixels[i]))) ++outliers;
    }
    EXPECT_GT(sum, 1) << method;  // the image is not black
    // Rays at edges may hit either side. All other pixels differ by rounding only.
    EXPECT_LE(outliers, a.pixels.size() / 200) << method;
    EXPECT_GT(a.cost.traceMs, 0) << method;
    rays = b.cost.rays;
  }
  EXPECT_NEAR(static_cast<double>(renderer.countRays("fresnel", parameters)), static_cast<double>(rays),
              0.002 * static_cast<double>(rays));
}

TEST(VulkanRenderer, RegionIsAPartOfTheImage) {
  const pack::Scene scene = makeScene();
  Renderer renderer(scene, {});
  render::RenderParameters parameters = render::defaultParameters(scene);
  const render::RenderResult whole = renderer.render("fresnel", parameters);
  parameters.region = {10, 7, 20, 11};
  const render::RenderResult part = renderer.render("fresnel", parameters);
  ASSERT_EQ(part.width, 20u);
  for (std::size_t y = 0; y < 11; ++y)
    for (std::size_t x = 0; x < 20 * 3; ++x)
      ASSERT_EQ(part.pixels[y * 60 + x], whole.pixels[(y + 7) * scene.width * 3 + 30 + x]);
}

// Expects an Error whose message contains all key words.
template <typename Call>
void expectError(const Call& call, const std::vector<std::string>& keyWords) {
  try {
    call();
    ADD_FAILURE() << "no error";
  } catch (const Error& error) {
    for (const std::string& word : keyWords)
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << word << " in: " << error.what();
  }
}

TEST(VulkanRenderer, DepthOverTheRecursionLimitIsRejected) {
  const pack::Scene scene = makeScene();
  Renderer renderer(scene, {});
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.depth = renderer.maxDepth("stokes") + 1;
  const std::string limit = std::to_string(renderer.maxDepth("stokes"));
  expectError([&] { renderer.render("fresnel", parameters); }, {"--depth", limit, "iterative"});
  expectError([&] { renderer.countRays("fresnel", parameters); }, {"--depth", limit, "iterative"});
  // An iterative method does not recurse.
  parameters.region = {0, 0, 2, 2};
  EXPECT_NO_THROW(renderer.render("fresnel-iterative", parameters));
  parameters.depth = 12;
  EXPECT_NO_THROW(renderer.render("fresnel", parameters));
}

TEST(VulkanRenderer, UnknownDeviceIsRejected) {
  const pack::Scene scene = makeScene();
  expectError([&] { Renderer(scene, {"no such device", 0}); }, {"--device", "'no such device'", "--list-devices"});
  expectError([&] { Renderer(scene, {"99", 0}); }, {"--device", "'99'", "--list-devices"});
}

TEST(VulkanRenderer, ListsTheDevices) {
  const std::vector<DeviceDescription> list = devices();
  ASSERT_FALSE(list.empty());
  const auto isDefault = [](const DeviceDescription& d) { return d.isDefault; };
  ASSERT_EQ(std::count_if(list.begin(), list.end(), isDefault), 1);
  const DeviceDescription& byDefault = *std::find_if(list.begin(), list.end(), isDefault);
  EXPECT_TRUE(byDefault.problem.empty());
  const pack::Scene scene = makeScene();
  EXPECT_NE(Renderer(scene, {}).device().find(byDefault.name), std::string::npos);
}

}  // namespace
}  // namespace malus::vulkan
