// Motions of the camera against their geometry.
#include <cmath>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "render/viewer/fly_camera.h"
#include "render/viewer/orbit_camera.h"

namespace malus::viewer {
namespace {

constexpr double kTolerance = 1e-12;

pack::Camera cameraAt(const glm::dvec3& position, const glm::dvec3& target) {
  pack::Camera camera;
  placeUpright(camera, position, target - position);
  return camera;
}

void expectNear(const glm::dvec3& a, const glm::dvec3& b, double tolerance = 1e-12) {
  EXPECT_LE(glm::length(a - b), tolerance) << a.x << " " << a.y << " " << a.z;
}

void expectRightHanded(const pack::Camera& c) {
  expectNear(glm::cross(c.right, c.up), -c.forward);
  EXPECT_NEAR(glm::length(c.forward), 1, kTolerance);
  EXPECT_NEAR(c.right.y, 0, kTolerance);  // the horizon stays level
  EXPECT_GT(c.up.y, 0);
}

TEST(OrbitCamera, AQuarterTurnToTheRightLooksFromTheRight) {
  pack::Camera camera = cameraAt({0, 0, 4}, {0, 0, 0});
  orbit(camera, {0, 0, 0}, 90, 0);
  expectNear(camera.position, {4, 0, 0});
  expectNear(camera.forward, {-1, 0, 0});
  expectRightHanded(camera);
}

TEST(OrbitCamera, PitchMovesUpAndLooksDown) {
  pack::Camera camera = cameraAt({0, 0, 2}, {0, 0, 0});
  orbit(camera, {0, 0, 0}, 0, 30);
  expectNear(camera.position, {0, 1, std::sqrt(3.0)});
  expectNear(camera.forward, {0, -0.5, -std::sqrt(3.0) / 2});
}

TEST(OrbitCamera, KeepsDistanceAndHorizonOverManySteps) {
  const glm::dvec3 pivot(1, 2, 3);
  pack::Camera camera = cameraAt({5, 3, -2}, pivot);
  const double distance = glm::length(pivot - camera.position);
  for (int i = 0; i < 1000; ++i) orbit(camera, pivot, 0.37 * i, 11);  // far over the pole
  EXPECT_NEAR(glm::length(pivot - camera.position), distance, 1e-9);
  expectRightHanded(camera);
  EXPECT_LT(camera.forward.y, -0.99);  // stopped near the pole
}

TEST(OrbitCamera, PanOfAWholeHeightMovesThePivotOutOfTheImage) {
  pack::Camera camera = cameraAt({0, 0, 3}, {0, 0, 0});
  camera.verticalFovDegrees = 90;  // 6 metres high at the distance of 3
  glm::dvec3 pivot(0);
  pan(camera, pivot, 0.5, 1);
  expectNear(pivot, {3, 6, 0});
  expectNear(camera.position, {3, 6, 3});
}

TEST(OrbitCamera, ZoomDividesTheDistance) {
  pack::Camera camera = cameraAt({0, 0, 3}, {0, 0, 1});
  camera.orthographicHeight = 2;
  zoom(camera, {0, 0, 1}, 4);
  expectNear(camera.position, {0, 0, 1.5});
  EXPECT_NEAR(camera.orthographicHeight, 0.5, kTolerance);
}

TEST(FlyCamera, LooksInPlaceAndMovesAlongItsAxes) {
  pack::Camera camera = cameraAt({1, 2, 3}, {1, 2, 2});
  look(camera, 90, 0);
  expectNear(camera.position, {1, 2, 3});
  expectNear(camera.forward, {1, 0, 0});
  fly(camera, 2, 1, 0.5);
  expectNear(camera.position, {3, 2.5, 4});
  look(camera, 0, 45);
  EXPECT_NEAR(camera.forward.y, std::sqrt(0.5), kTolerance);
  expectNear(pivotAhead(camera, 2), camera.position + 2.0 * camera.forward);
}

}  // namespace
}  // namespace malus::viewer
