// The render thread with a renderer whose images contain their camera and method: which wishes are shown, and when.
#include "render/viewer/render_thread.h"

#include <atomic>
#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "meshprep/base/error.h"
#include "render/viewer/orbit_camera.h"
#include "tests/render/test_scene.h"
#include "tests/render/viewer/host_store.h"

namespace malus::viewer {
namespace {
using Clock = std::chrono::steady_clock;

struct Counters {
  std::atomic<int> calls{0}, pixels{0};
  std::atomic<int> nsPerPixel{0};
  std::atomic<bool> fails{false};
};

// Each pixel: position of the camera, then the number of the row.
class SlowRenderer final : public render::Renderer {
 public:
  SlowRenderer(const pack::Scene& scene, Counters& counters) : scene_(scene), counters_(counters) {}
  render::Backend backend() const override { return render::Backend::embree; }
  std::string device() const override { return "slow"; }
  std::vector<std::string> methods() const override { return {}; }
  bool updateScene() override { return true; }
  render::RenderResult render(std::string_view, const render::RenderParameters& p) override {
    if (counters_.fails) throw Error("", "the device is lost");
    ++counters_.calls;
    const std::size_t count = std::size_t{p.region.width} * p.region.height;
    counters_.pixels += static_cast<int>(count);
    const double ms = 1e-6 * counters_.nsPerPixel * static_cast<double>(count);
    std::this_thread::sleep_for(std::chrono::duration<double, std::milli>(ms));
    render::RenderResult result;
    result.width = p.region.width;
    result.height = p.region.height;
    result.pixels.resize(3 * count);
    for (std::size_t i = 0; i < count; ++i) {
      result.pixels[3 * i] = static_cast<float>(scene_.camera.position.x);
      result.pixels[3 * i + 1] = static_cast<float>(p.region.y + i / p.region.width);
    }
    result.cost.traceMs = result.cost.wallMs = ms;
    return result;
  }

 private:
  const pack::Scene& scene_;
  Counters& counters_;
};

class FakeHost final : public Host {
 public:
  mutable Counters counters;
  std::unique_ptr<render::Renderer> makeRenderer(render::Backend, const pack::Scene& scene,
                                                 const render::RendererOptions&) const override {
    return std::make_unique<SlowRenderer>(scene, counters);
  }
  render::RenderParameters renderParameters(const render::JobSettings& job, const pack::Scene&) const override {
    render::RenderParameters parameters;
    parameters.width = job.width;
    parameters.height = job.height;
    parameters.region = {0, 0, job.width, job.height};
    return parameters;
  }
  render::ImageChoice chooseImage(const render::JobSettings& job, const render::RenderParameters&,
                                  const pack::Scene&) const override {
    if (job.method == "sp") throw Error("", "cannot be rendered");
    return {job.method, "", {}, {}};
  }
  render::PixelTruth pixelTruth(const pack::Scene&, const render::RenderParameters&) const override { return {}; }
  bool interrupted() const override { return false; }
};

struct Fixture {
  FakeHost host;
  test::HostStores stores;
  pack::Scene scene = malus::test::emptyScene(1);
  std::atomic<int> notes{0};
  RenderThread thread{host, scene, {}, stores, {}, [this] { ++notes; }};

  static Wish wish(std::uint64_t generation, double x) {
    Wish wish;
    wish.generation = generation;
    wish.width = 320;
    wish.height = 240;
    wish.state.camera.position.x = x;
    wish.state.sides[0].method = wish.state.sides[1].method = "fresnel";
    return wish;
  }
};

double sinceMs(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

TEST(RenderThread, RefinesAStillViewToEveryRowOfTheFullResolution) {
  Fixture f;
  f.host.counters.nsPerPixel = 2000;  // 154 ms per image
  f.thread.submit(Fixture::wish(1, 7));
  ASSERT_TRUE(f.thread.waitFor(1, true, 20000));
  const Published published = f.thread.published();
  const ImageRows& fine = published.sides[0].fine;
  ASSERT_TRUE(fine.isComplete());
  EXPECT_EQ(fine.width, 320u);
  EXPECT_EQ(fine.height, 240u);
  const std::span<float> values = fine.store->values();
  for (std::size_t y = 0; y < 240; ++y)
    for (std::size_t x = 0; x < 320; x += 40) {
      EXPECT_EQ(values[3 * (y * 320 + x)], 7);
      EXPECT_EQ(values[3 * (y * 320 + x) + 1], static_cast<float>(y));
    }
  EXPECT_TRUE(published.sides[1].method.empty());  // not split
  EXPECT_GE(f.notes, 3);                           // coarse, bands, complete
}

TEST(RenderThread, ShowsTheNewestOfManyWishes) {
  Fixture f;
  f.host.counters.nsPerPixel = 3000;  // 230 ms per image
  for (std::uint64_t i = 1; i <= 60; ++i) {
    f.thread.submit(Fixture::wish(i, static_cast<double>(i)));
    std::this_thread::sleep_for(std::chrono::milliseconds(3));
  }
  ASSERT_TRUE(f.thread.waitFor(60, false, 20000));
  const Published published = f.thread.published();
  EXPECT_EQ(published.generation, 60u);
  EXPECT_EQ(published.sides[0].coarse.store->values()[0], 60);
  // Not one image per wish: they were replaced while they waited.
  EXPECT_LT(f.host.counters.calls, 60);
}

TEST(RenderThread, ANewWishEndsAnImageAtFullResolution) {
  Fixture f;
  f.host.counters.nsPerPixel = 100000;  // 7.7 s per image
  f.thread.submit(Fixture::wish(1, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(1500));  // coarse images take up to half a second at first
  const auto start = Clock::now();
  f.thread.submit(Fixture::wish(2, 2));
  ASSERT_TRUE(f.thread.waitFor(2, false, 20000));
  EXPECT_LT(sinceMs(start), 1500);
}

TEST(RenderThread, EndsWhileItRenders) {
  auto f = std::make_unique<Fixture>();
  f->host.counters.nsPerPixel = 100000;
  f->thread.submit(Fixture::wish(1, 1));
  std::this_thread::sleep_for(std::chrono::milliseconds(1000));
  const auto start = Clock::now();
  f.reset();
  EXPECT_LT(sinceMs(start), 1000);
}

TEST(RenderThread, ASideThatCannotBeRenderedKeepsTheOtherOne) {
  Fixture f;
  Wish wish = Fixture::wish(1, 1);
  wish.state.isSplit = true;
  wish.state.sides[1].method = "sp";
  f.thread.submit(wish);
  ASSERT_TRUE(f.thread.waitFor(1, true, 20000));
  const Published published = f.thread.published();
  EXPECT_TRUE(published.sides[0].fine.isComplete());
  EXPECT_NE(published.sides[1].problem.find("cannot be rendered"), std::string::npos);
  // The next method works again.
  wish.generation = 2;
  wish.state.sides[1].method = "stokes";
  f.thread.submit(wish);
  ASSERT_TRUE(f.thread.waitFor(2, true, 20000));
  EXPECT_TRUE(f.thread.published().sides[1].problem.empty());
}

TEST(RenderThread, ALostDeviceIsReported) {
  Fixture f;
  f.host.counters.fails = true;
  f.thread.submit(Fixture::wish(1, 1));
  EXPECT_FALSE(f.thread.waitFor(1, false, 20000));
  EXPECT_NE(f.thread.failure().find("lost"), std::string::npos);
}

TEST(RenderThread, RendersContinuouslyForTheMedian) {
  Fixture f;
  Wish wish = Fixture::wish(1, 1);
  wish.state.isContinuous = true;
  f.host.counters.nsPerPixel = 100;  // 8 ms
  f.thread.submit(wish);
  for (int i = 0; i < 200 && f.thread.published().images < 6; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  EXPECT_GE(f.thread.published().images, 6u);
  EXPECT_NEAR(f.thread.published().sides[0].medianMs, 7.68, 0.2);
}

TEST(Wish, OnlyTheFilterOfAnImageWithoutStokesVectorsNeedsARender) {
  Wish before = Fixture::wish(1, 1), after = before;
  before.state.sides[0].method = after.state.sides[0].method = "stokes";
  after.state.filter.kind = FilterKind::linear;
  after.state.exposureEv = 3;
  after.state.shown = Quantity::dolp;
  EXPECT_FALSE(needsRender(before, after, {}));
  before.state.sides[0].method = after.state.sides[0].method = "sp";
  EXPECT_TRUE(needsRender(before, after, {}));
  after = before;
  after.state.camera.position.y = 1e-9;
  EXPECT_TRUE(needsRender(before, after, {}));
  EXPECT_TRUE(isSamePreparation(before, after, {}));
}

}  // namespace
}  // namespace malus::viewer
