// The reference in tiles against the reference in one call, and work that a change of the view ends.
#include "render/viewer/background.h"

#include <chrono>
#include <thread>

#include <gtest/gtest.h>

#include "tests/render/test_scene.h"
#include "tests/render/viewer/host_store.h"

namespace malus::viewer {
namespace {

// With the real reference and ground truth.
class ReferenceHost final : public Host {
 public:
  std::unique_ptr<render::Renderer> makeRenderer(render::Backend backend, const pack::Scene& scene,
                                                 const render::RendererOptions& options) const override {
    return render::makeRenderer(backend, scene, options);
  }
  render::RenderParameters renderParameters(const render::JobSettings& job, const pack::Scene& scene) const override {
    render::RenderParameters parameters = render::defaultParameters(scene);
    parameters.width = job.width;
    parameters.height = job.height;
    parameters.region = {0, 0, job.width, job.height};
    return parameters;
  }
  render::ImageChoice chooseImage(const render::JobSettings& job, const render::RenderParameters&,
                                  const pack::Scene&) const override {
    return {job.method, "", {}, {}};
  }
  render::PixelTruth pixelTruth(const pack::Scene& scene, const render::RenderParameters& parameters) const override {
    return render::GroundTruth(scene, 1).render(parameters).front();
  }
  bool interrupted() const override { return false; }
};

// A mirror of glass below a bright environment.
pack::Scene glassFloor() {
  pack::Scene scene = malus::test::emptyScene(2);
  scene.environment.radiance = {1, 2, 3};
  scene.camera.verticalFovDegrees = 60;
  const auto glass = malus::test::dielectric(pack::MaterialKind::mirrorGlass, 1.5);
  malus::test::addMaterial(scene, glass);
  malus::test::addSquare(scene, 0, {0, 0, 0}, {0, 1, 0}, 2);
  malus::test::look(scene, {0, 1, 2}, {0, 0, 0});
  return scene;
}

struct Fixture {
  ReferenceHost host;
  test::HostStores stores;
  pack::Scene scene = glassFloor();
  Background background{host, scene, {}, stores, {}, [] {}};

  Wish wish(std::uint64_t generation) const {
    Wish wish;
    wish.generation = generation;
    wish.width = 120;
    wish.height = 90;
    wish.state.camera = scene.camera;
    return wish;
  }
  template <class Condition>
  bool waitUntil(Condition isMet) const {
    for (int i = 0; i < 2000; ++i) {
      if (isMet(background.state())) return true;
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
    return false;
  }
};

TEST(Background, TilesAreTheReference) {
  Fixture f;
  f.background.setView(f.wish(1));
  f.background.requestReference(true);
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.reference.isComplete(); }));
  const auto renderer = render::makeRenderer(render::Backend::reference, f.scene, {});
  render::JobSettings job;
  job.width = 120;
  job.height = 90;
  const render::RenderResult whole = renderer->render({}, f.host.renderParameters(job, f.scene));
  const std::span<float> tiles = f.background.state().reference.store->values();
  ASSERT_EQ(whole.pixels.size(), tiles.size());
  for (std::size_t i = 0; i < tiles.size(); ++i) ASSERT_EQ(tiles[i], whole.pixels[i]) << i;
}

TEST(Background, ErrorsAreThoseOfTheFilteredImages) {
  Fixture f;
  f.background.setView(f.wish(1));
  f.background.requestReference(true);
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.reference.isComplete(); }));
  const ImageRows reference = f.background.state().reference;
  // Side 1 is twice as bright: a relative error of 1 behind every filter.
  ImageRows bright = reference;
  bright.store = f.stores.take(reference.store->values().size());
  for (std::size_t i = 0; i < bright.store->values().size(); ++i)
    bright.store->values()[i] = 2 * reference.store->values()[i];
  f.background.requestErrors({1, {reference, bright}, render::linearPolarizer(30), 0, false, true});
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.errors[1].has_value(); }));
  const BackgroundState state = f.background.state();
  EXPECT_EQ(state.errors[0]->relRms, 0);
  EXPECT_NEAR(state.errors[1]->relRms, 1, 1e-6);
  ASSERT_TRUE(state.flip);
  EXPECT_EQ(state.flip->values()[60], 0);
  EXPECT_GT(state.flip->values()[120 * 90 + 45 * 120 + 60], 0.01f);
}

TEST(Background, AChangeOfTheViewDropsTheResults) {
  Fixture f;
  f.background.setView(f.wish(1));
  f.background.requestReference(true);
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.reference.rows > 0; }));
  f.background.requestReference(false);
  f.background.setView(f.wish(2));
  EXPECT_EQ(f.background.state().generation, 2u);
  std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(f.background.state().reference.rows, 0u);
}

TEST(Background, FindsTheSurfaceUnderThePixel) {
  Fixture f;
  f.background.setView(f.wish(1));
  f.background.requestPixel({1, 60, 45});
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.truth.has_value(); }));
  const render::PixelTruth truth = *f.background.state().truth;
  EXPECT_TRUE(truth.isValid);
  EXPECT_NEAR(truth.incidence, std::atan(2.0), 0.02);  // 2 m away, 1 m above
  f.background.requestPixel({1, 60, 0});
  ASSERT_TRUE(f.waitUntil([](const BackgroundState& s) { return s.truth && s.pixel.y == 0; }));
  EXPECT_FALSE(f.background.state().truth->isValid);
}

}  // namespace
}  // namespace malus::viewer
