#include "render/vulkan/renderer.h"
#include "render/vulkan/device_description.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/embree/renderer.h"
#include "render/scene/methods.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

TEST(VulkanRenderer, EqualsEmbreeInEveryMethod) {
  const pack::Scene scene = test::mixedScene();
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

// Materials, lights, environment and camera change below the renderer, as for a new renderer.
TEST(VulkanRenderer, TakesOverAChangedScene) {
  pack::Scene scene = test::mixedScene();
  const render::RenderParameters parameters = render::defaultParameters(scene);
  Renderer renderer(scene, {});
  const std::vector<float> first = renderer.render("stokes", parameters).pixels;
  for (pack::Material& m : scene.materials) {
    m.eta += glm::dvec3(0.1, 0.2, 0.3);
    m.albedo *= 0.5;
  }
  scene.lights.push_back({{1, 2, 3}, {4, 5, 6}});
  scene.environment.radiance += glm::dvec3(0.1);
  scene.camera.position += 0.1 * scene.camera.right;
  ASSERT_TRUE(renderer.updateScene());
  const std::vector<float> second = renderer.render("stokes", parameters).pixels;
  EXPECT_NE(first, second);
  EXPECT_EQ(second, Renderer(scene, {}).render("stokes", parameters).pixels);
  // The shader of a hit follows from the kind of its material.
  scene.materials[0].kind =
      scene.materials[0].kind == pack::MaterialKind::lambert ? pack::MaterialKind::metal : pack::MaterialKind::lambert;
  EXPECT_FALSE(renderer.updateScene());
}

TEST(VulkanRenderer, RegionIsAPartOfTheImage) {
  const pack::Scene scene = test::mixedScene();
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

TEST(VulkanRenderer, UnknownDeviceIsRejected) {
  const pack::Scene scene = test::mixedScene();
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
  const pack::Scene scene = test::mixedScene();
  EXPECT_NE(Renderer(scene, {}).device().find(byDefault.name), std::string::npos);
}

}  // namespace
}  // namespace malus::vulkan
