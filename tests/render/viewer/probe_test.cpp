// Numbers of the probe against closed forms, and the states of a recording.
#include "render/viewer/probe.h"

#include <cmath>
#include <filesystem>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/viewer/recorder.h"
#include "tests/render/test_scene.h"
#include "tests/render/viewer/host_store.h"

namespace malus::viewer {
namespace {
constexpr double kPi = std::numbers::pi;

TEST(Probe, EllipsesOfKnownStates) {
  const Ellipse linear = ellipse({2, 0, 2, 0});  // along 45 degrees
  EXPECT_NEAR(linear.angle, kPi / 4, 1e-12);
  EXPECT_NEAR(linear.ellipticity, 0, 1e-12);
  EXPECT_NEAR(linear.degree, 1, 1e-12);
  EXPECT_NEAR(ellipse({1, 0, 0, 1}).ellipticity, kPi / 4, 1e-12);    // right circular
  EXPECT_NEAR(ellipse({1, 0, 0, -1}).ellipticity, -kPi / 4, 1e-12);  // left
  // Axes 2 : 1 along x: S1 = (4 - 1), S3 = 2 * 2 * 1.
  EXPECT_NEAR(std::tan(ellipse({10, 3, 0, 4}).ellipticity), 0.5, 1e-12);
  EXPECT_NEAR(ellipse({10, 3, 0, 4}).degree, 0.5, 1e-12);
  EXPECT_EQ(ellipse({1, 0, 0, 0}).degree, 0);
}

TEST(Probe, ReadsTheFineImageWhereItIsRenderedAndTheCoarseElsewhere) {
  const auto image = [](std::uint32_t size, std::uint32_t rows, float value) {
    ImageRows result{std::make_shared<test::HostStore>(15 * size * size), size, size, 15, rows};
    for (std::size_t i = 0; i < result.store->values().size(); ++i)
      result.store->values()[i] = i % 15 < 6 ? value : i % 15 == 7 ? 0.6f * value : 0;  // S1 of green
    return result;
  };
  PublishedSide side;
  side.coarse = image(2, 2, 1);
  side.fine = image(8, 4, 2);
  const auto upper = probeLight(side, 7, 3, 8, 8), lower = probeLight(side, 7, 4, 8, 8);
  ASSERT_TRUE(upper && lower);
  EXPECT_EQ(upper->stokes[1][0], 2);
  EXPECT_EQ(lower->stokes[1][0], 1);
  EXPECT_NEAR(upper->dolp[1], 0.6, 1e-6);
  EXPECT_EQ(upper->dolp[0], 0);
  EXPECT_NEAR(upper->luminance[1], 0.7152 * 1.2, 1e-6);
  side.fine.channels = side.coarse.channels = 3;
  EXPECT_FALSE(probeLight(side, 0, 0, 8, 8));
}

TEST(Probe, DiattenuationIsOneAtBrewstersAngle) {
  pack::Scene scene = malus::test::emptyScene(1);
  malus::test::addMaterial(scene, malus::test::dielectric(pack::MaterialKind::mirrorGlass, 1.5));
  malus::test::addMaterial(scene, malus::test::emitter({1, 1, 1}));
  render::PixelTruth truth;
  truth.isValid = true;
  truth.material = 0;
  truth.incidence = std::atan(1.5);
  const auto surface = probeSurface(truth, scene);
  ASSERT_TRUE(surface && surface->diattenuation);
  EXPECT_NEAR(surface->diattenuation->at(0), 1, 1e-9);
  EXPECT_NEAR(surface->incidenceDegrees, 56.3099, 1e-4);
  EXPECT_EQ(surface->kind, "mirror-glass");
  truth.incidence = 0;
  EXPECT_NEAR(probeSurface(truth, scene)->diattenuation->at(2), 0, 1e-9);
  truth.material = 1;
  EXPECT_FALSE(probeSurface(truth, scene)->diattenuation);
  truth.isValid = false;
  EXPECT_FALSE(probeSurface(truth, scene));
}

TEST(Recorder, TurnsOnceAroundThePivotAndRestoresTheView) {
  ViewState state;
  state.camera.position = {0, 0, 4};
  const std::string folder = std::filesystem::path(testing::TempDir()) / "turntable";
  Recorder recorder;
  recorder.start(Recording::turntable, folder, 4, state);
  double x = 0;
  for (const double expected : {0.0, 4.0, 0.0, -4.0}) {
    recorder.apply(state);
    EXPECT_NEAR(state.camera.position.x, expected, 1e-9);
    x = state.camera.position.x;
    recorder.next(state);
  }
  EXPECT_NEAR(x, -4, 1e-9);
  EXPECT_FALSE(recorder.isRecording());
  EXPECT_EQ(state.camera.position, glm::dvec3(0, 0, 4));
}

TEST(Recorder, RestoresTheViewWhenItIsStopped) {
  ViewState state;
  state.camera.position = {0, 0, 4};
  state.filter.polarizerDegrees = 30;
  const std::string folder = std::filesystem::path(testing::TempDir()) / "stopped";
  Recorder recorder;
  for (const Recording what : {Recording::turntable, Recording::polarizer}) {
    recorder.start(what, folder, 4, state);
    recorder.next(state);
    recorder.apply(state);
    recorder.stop(state);
    EXPECT_FALSE(recorder.isRecording());
    EXPECT_EQ(state.camera.position, glm::dvec3(0, 0, 4));
    EXPECT_EQ(state.filter.kind, FilterKind::none);
    EXPECT_EQ(state.filter.polarizerDegrees, 30);
  }
  state.camera.position = {0, 0, 5};
  recorder.stop(state);  // nothing is recorded
  EXPECT_EQ(state.camera.position, glm::dvec3(0, 0, 5));
}

TEST(Recorder, SweepsThePolarizerByAHalfTurn) {
  ViewState state;
  const std::string folder = std::filesystem::path(testing::TempDir()) / "sweep";
  Recorder recorder;
  recorder.start(Recording::polarizer, folder, 18, state);
  recorder.next(state);
  recorder.apply(state);
  EXPECT_EQ(state.filter.kind, FilterKind::linear);
  EXPECT_EQ(state.filter.polarizerDegrees, 10);
  EXPECT_EQ(recorder.file(), folder + "/frame-001.png");
  for (int i = 1; i < 18; ++i) recorder.next(state);
  EXPECT_EQ(state.filter.kind, FilterKind::none);
}

}  // namespace
}  // namespace malus::viewer
