// Closed forms of spot and directional lights, of orthographic cameras and of cameras by intrinsics, on every renderer.
#include <cmath>
#include <numbers>

#include "tests/render/render_everywhere.h"
#include "tests/render/test_scene.h"

namespace malus {
namespace {

using pack::LightKind;
using test::renderEverywhere;

constexpr double kPi = std::numbers::pi, kAlbedo = 0.6, kDegree = kPi / 180;

// A diffuse floor in the plane z = 0; the camera looks at its origin.
pack::Scene litFloor(const pack::LightSource& light) {
  pack::Scene scene = test::emptyScene(2);
  test::look(scene, {0, 0, 5}, {0, 0, 0});
  pack::Material floor;
  floor.name = "floor";
  floor.albedo = glm::dvec3(kAlbedo);
  test::addSquare(scene, test::addMaterial(scene, floor), {0.1, 0.2, 0}, {0, 0, 1}, 3);
  scene.lights = {light};
  return scene;
}

void expectRadiance(const pack::Scene& scene, double radiance) {
  for (const auto& [name, result] : renderEverywhere(scene))
    EXPECT_NEAR(result.pixels[1], radiance, 2e-6 * std::max(radiance, 1.0)) << name;
}

TEST(LightClosedForms, SpotFallsOffBetweenItsCones) {
  // The floor's origin is at an angle of 30 degrees from the direction of a light at a distance of 2.
  pack::LightSource spot{};
  spot.kind = LightKind::spot;
  spot.position = {1, 0, std::sqrt(3.0)};
  spot.intensity = {1, 8, 2};
  spot.direction = {0, 0, -1};
  const double full = kAlbedo / kPi * 8 * std::cos(30 * kDegree) / 4;
  const auto expectFalloff = [&](double inner, double outer, double factor) {
    spot.innerConeDegrees = inner;
    spot.outerConeDegrees = outer;
    expectRadiance(litFloor(spot), full * factor);
  };
  expectFalloff(31, 45, 1);
  expectFalloff(10, 29, 0);
  const double between = (std::cos(30 * kDegree) - std::cos(50 * kDegree)) / (1 - std::cos(50 * kDegree));
  expectFalloff(0, 50, between * between);
}

TEST(LightClosedForms, DirectionalLightComesFromInfinity) {
  pack::LightSource sun{};
  sun.kind = LightKind::directional;
  sun.intensity = {1, 3, 2};
  sun.direction = {0.6, 0, -0.8};
  pack::Scene scene = litFloor(sun);
  expectRadiance(scene, kAlbedo / kPi * 3 * 0.8);
  // A square far up the way of the light blocks it; one beside it does not.
  pack::Scene blocked = scene, beside = scene;
  test::addSquare(blocked, 0, {-6, 0, 8}, {0, 0, 1}, 0.5);
  test::addSquare(beside, 0, {-6, 2, 8}, {0, 0, 1}, 0.5);
  expectRadiance(blocked, 0);
  expectRadiance(beside, kAlbedo / kPi * 3 * 0.8);
  // A medium absorbs on the way to the camera only, as for the environment.
  scene.materials[0].outsideAbsorption = glm::dvec3(0.1);
  expectRadiance(scene, kAlbedo / kPi * 3 * 0.8 * std::exp(-0.5));
}

TEST(LightClosedForms, LightsOfEveryKindAddUp) {
  pack::LightSource point{}, spot{}, sun{};
  point.position = {0, 0, 2};
  point.intensity = glm::dvec3(4);
  spot.kind = LightKind::spot;
  spot.position = {0, 0, 3};
  spot.intensity = glm::dvec3(9);
  spot.direction = {0, 0, -1};
  spot.outerConeDegrees = 20;
  sun.kind = LightKind::directional;
  sun.intensity = glm::dvec3(0.5);
  sun.direction = {0, 0, -1};
  pack::Scene scene = litFloor(point);
  scene.lights = {sun, point, spot};
  expectRadiance(scene, kAlbedo / kPi * 2.5);
}

// Pixels of the image of a bright square that are lit, in the order of the rows; the others must be black.
std::vector<bool> litPixels(const render::RenderResult& result) {
  std::vector<bool> lit;
  for (std::size_t i = 0; i < std::size_t{result.width} * result.height; ++i) {
    const float value = result.pixels[i * result.channels];
    EXPECT_TRUE(value == 0 || value == 1) << value;
    lit.push_back(value > 0);
  }
  return lit;
}

TEST(CameraClosedForms, OrthographicRaysAreParallel) {
  for (const double distance : {0.5, 40.0}) {
    pack::Scene scene = test::emptyScene(1);
    test::look(scene, {1, 2, 3}, {1, 2, 0});
    test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {1.5, 2, 3 - distance}, {0, 0, 1},
                    0.5);
    scene.camera.orthographicHeight = 2;
    scene.width = 16;
    scene.height = 8;
    // A pixel is 0.25 wide: the square covers columns 8 to 11 and rows 2 to 5.
    std::vector<bool> expected(128);
    for (std::size_t y = 2; y < 6; ++y)
      for (std::size_t x = 8; x < 12; ++x) expected[y * 16 + x] = true;
    for (const auto& [name, result] : renderEverywhere(scene)) EXPECT_EQ(litPixels(result), expected) << name;
  }
}

TEST(CameraClosedForms, IntrinsicsPlaceThePrincipalPoint) {
  // fx = 20, fy = 10, cx = 3, cy = 6 in an image of 16 x 8: a square of 0.4 x 0.4 at distance 2 about the axis covers
  // 4 x 2 pixels about (3, 6).
  pack::Scene scene = test::emptyScene(1);
  test::look(scene, {0, 0, 2}, {0, 0, 0});
  test::addSquare(scene, test::addMaterial(scene, test::emitter(glm::dvec3(1))), {0, 0, 0}, {0, 0, 1}, 0.2);
  scene.width = 16;
  scene.height = 8;
  scene.camera.verticalFovDegrees = 2 * std::atan(8 / 20.0) / kDegree;
  scene.camera.pixelAspect = 10.0 / 20;
  scene.camera.middleX = (8 - 3) / 20.0 * 10 / 8;
  scene.camera.middleY = (6 - 4) / 8.0;
  std::vector<bool> expected(128);
  for (std::size_t y = 5; y < 7; ++y)
    for (std::size_t x = 1; x < 5; ++x) expected[y * 16 + x] = true;
  for (const auto& [name, result] : renderEverywhere(scene)) EXPECT_EQ(litPixels(result), expected) << name;
}

}  // namespace
}  // namespace malus
