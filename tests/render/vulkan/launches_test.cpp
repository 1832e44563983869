// Images in several submissions: the sizes of launches, and images that do not depend on them.
#include "render/vulkan/launches.h"

#include <csignal>

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <vector>

#include <gtest/gtest.h>

#include "meshprep/base/interrupt.h"
#include "render/vulkan/renderer.h"
#include "tests/render/vulkan/limits.h"
#include "tests/render/vulkan/scenes.h"

namespace malus::vulkan {
namespace {

// A simulated device: a launch takes a constant time and the cost of its pixels.
struct Launched {
  double longestMs = 0;
  std::size_t launches = 0;
};
Launched launchAll(LaunchSize& size, std::uint32_t width, std::uint32_t height,
                   const std::function<double(std::uint32_t y)>& pixelMs) {
  Launched result;
  size.beginImage();
  for (LaunchRegions regions({0, 0, width, height}); !regions.isDone(); ++result.launches) {
    const render::Region part = regions.next(size.pixels(1));
    double ms = 0.1;
    for (std::uint32_t y = part.y; y < part.y + part.height; ++y) ms += part.width * pixelMs(y);
    size.add(std::uint64_t{part.width} * part.height, 1, ms);
    result.longestMs = std::max(result.longestMs, ms);
  }
  return result;
}

TEST(VulkanLaunches, StayBelowHalfASecond) {
  // From 10 million to 100 rays per second, alike or with a cost that rises tenfold along a few rows.
  for (const double ms : {1e-7, 1e-5, 1e-4, 1e-3, 1e-2, 0.5}) {
    LaunchSize equal, rising;
    const auto constant = [&](std::uint32_t) { return ms; };
    const auto rise = [&](std::uint32_t y) { return ms * std::pow(10, std::clamp((y - 500.0) / 20, 0.0, 1.0)); };
    EXPECT_LT(launchAll(equal, 1000, 1000, constant).longestMs, 500) << ms;
    EXPECT_LT(launchAll(rising, 1000, 1000, rise).longestMs, 500) << ms;
    // The next image expects the cost of the most expensive rows.
    const Launched next = launchAll(rising, 1000, 1000, rise);
    EXPECT_LT(next.longestMs, 1.1 * kLaunchMs + 1) << ms;
    EXPECT_LT(static_cast<double>(next.launches), 3 + 2e6 * 10 * ms / kLaunchMs) << ms;  // rows are whole or cut
  }
}

TEST(VulkanLaunches, CheapImageIsOneLaunch) {
  LaunchSize size;
  const auto cheap = [](std::uint32_t) { return 1e-6; };
  EXPECT_LT(launchAll(size, 1000, 1000, cheap).launches, 7u);
  EXPECT_EQ(launchAll(size, 1000, 1000, cheap).launches, 1u);
}

TEST(VulkanLaunches, OneDelayedLaunchHasNoLastingEffect) {
  LaunchSize size;
  size.beginImage();
  size.add(1, 1, 1000);
  EXPECT_EQ(size.pixels(1), 1u);
  size.add(1'000'000, 1, 4);
  const auto cheap = [](std::uint32_t) { return 4e-6; };
  EXPECT_LE(launchAll(size, 1000, 1000, cheap).launches, 1000u);
  EXPECT_LE(launchAll(size, 1000, 1000, cheap).launches, 100u);
  std::size_t images = 2;
  while (launchAll(size, 1000, 1000, cheap).launches > 1) ASSERT_LT(++images, 7u);
}

TEST(VulkanLaunches, RaysPerPixelCount) {
  LaunchSize size;
  EXPECT_EQ(size.pixels(1), 256u);
  EXPECT_EQ(size.pixels(16), 16u);
  EXPECT_EQ(size.pixels(100000), 1u);
  size.add(16, 16, 100);
  EXPECT_EQ(size.pixels(1), 128u);
}

TEST(VulkanLaunches, RegionsCoverEachPixelOnce) {
  for (const std::uint64_t pixels : {1, 3, 7, 10, 15, 20, 33, 1000}) {
    std::vector<int> covered(7 * 5);
    for (LaunchRegions regions({2, 3, 7, 5}); !regions.isDone();) {
      const std::uint64_t first = regions.nextPixel();
      const render::Region part = regions.next(pixels);
      ASSERT_LE(part.width * part.height, pixels);
      ASSERT_GT(part.width * part.height, 0u);
      ASSERT_EQ((part.y - 3) * 7 + part.x - 2, first);
      for (std::uint32_t y = part.y; y < part.y + part.height; ++y)
        for (std::uint32_t x = part.x; x < part.x + part.width; ++x) ++covered.at((y - 3) * 7 + x - 2);
      if (part.height > 1) {
        ASSERT_EQ(part.width, 7u);
      }
    }
    EXPECT_EQ(std::count(covered.begin(), covered.end(), 1), 35) << pixels;
  }
}

pack::Scene makeScene() {
  pack::Scene scene = test::goldAndPaintScene();
  scene.width = 37;
  scene.height = 23;
  return scene;
}

struct Rendered {
  render::RenderResult image;
  std::uint64_t rays;
};
Rendered renderUnder(const char* limits, const render::Region& region) {
  const test::Limits scope(limits);
  const pack::Scene scene = makeScene();
  Renderer renderer(scene, {});
  render::RenderParameters parameters = render::defaultParameters(scene);
  parameters.region = region;
  return {renderer.render("stokes", parameters), renderer.countRays("stokes", parameters)};
}

TEST(VulkanLaunches, DoNotChangeTheImage) {
  const render::Region whole{0, 0, 37, 23};
  const Rendered expected = renderUnder("", whole);
  EXPECT_LE(expected.image.cost.launches, 5u);
  const std::set<float> values(expected.image.pixels.begin(), expected.image.pixels.end());
  EXPECT_GT(values.size(), 1000u);  // a pixel at a wrong place is seen
  // 15 floats per pixel: 660 bytes are 11 pixels.
  for (const char* limits : {"maxRayDispatchInvocationCount=11", "maxStorageBufferRange=660",
                             "timestampValidBits=0,maxMemoryAllocationSize=100000,maxRayDispatchInvocationCount=80"}) {
    const Rendered found = renderUnder(limits, whole);
    EXPECT_GE(found.image.cost.launches, 11u) << limits;
    EXPECT_GT(found.image.cost.traceMs, 0) << limits;
    EXPECT_EQ(found.image.pixels, expected.image.pixels) << limits;
    EXPECT_EQ(found.rays, expected.rays) << limits;
  }
}

TEST(VulkanLaunches, DoNotChangeARegion) {
  const render::Region part{5, 4, 10, 6};
  const Rendered expected = renderUnder("", part), found = renderUnder("maxRayDispatchInvocationCount=1", part);
  EXPECT_EQ(expected.image.cost.launches, 1u);
  EXPECT_EQ(found.image.cost.launches, 60u);
  EXPECT_EQ(found.image.pixels, expected.image.pixels);
  EXPECT_EQ(found.rays, expected.rays);
}

TEST(VulkanLaunches, InterruptEndsAnImageBetweenLaunches) {
  const pack::Scene scene = makeScene();
  Renderer renderer(scene, {});
  const render::RenderParameters parameters = render::defaultParameters(scene);
  const std::vector<float> expected = renderer.render("stokes", parameters).pixels;
  handleInterrupts();
  {
    const InterruptScope scope;
    std::raise(SIGINT);
    EXPECT_THROW(renderer.render("stokes", parameters), Interrupted);
  }
  const InterruptScope scope;  // clears the flag
  EXPECT_EQ(renderer.render("stokes", parameters).pixels, expected);
}

TEST(VulkanLaunches, ReportProgress) {
  // Launches of one pixel take long enough for several reports.
  const test::Limits scope("maxRayDispatchInvocationCount=1");
  const pack::Scene scene = makeScene();
  Renderer renderer(scene, {});
  std::vector<double> reported;
  renderer.setProgress([&](double fraction) { reported.push_back(fraction); });
  render::RenderParameters parameters = render::defaultParameters(scene);
  double ms = 0;
  for (std::uint32_t side = 40; reported.empty(); side *= 2) {
    ASSERT_LT(side, 2000u);
    parameters.width = parameters.height = parameters.region.width = parameters.region.height = side;
    ms = renderer.render("fresnel", parameters).cost.wallMs;
  }
  EXPECT_LE(static_cast<double>(reported.size()), ms / 1000);
  EXPECT_TRUE(std::is_sorted(reported.begin(), reported.end()));
  EXPECT_GT(reported.front(), 0);
  EXPECT_LT(reported.back(), 1);
}

}  // namespace
}  // namespace malus::vulkan
