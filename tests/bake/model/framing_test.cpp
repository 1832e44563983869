// The framing camera: all corners of the box are in the image, and the camera is not farther than that needs.
#include "bake/model/framing.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>

namespace malus::bake {
namespace {

struct Box {
  const char* name;
  glm::dvec3 low, high;
};

const Box kBoxes[] = {{"cube", {-1, -1, -1}, {1, 1, 1}},
                      {"tall", {0, 0, 0}, {1, 500, 1}},
                      {"wide", {-300, 0, 0}, {300, 1, 2}},
                      {"deep", {0, 0, -400}, {1, 1, 0}},
                      {"flat", {-1, 2, -3}, {4, 2, 5}},
                      {"wall", {0, 0, 0}, {0, 3, 7}},
                      {"line", {5, 0, 0}, {5, 0, 9}},
                      {"tiny", {1e-9, 1e-9, 0}, {3e-9, 2e-9, 1e-9}},
                      {"huge", {-3e10, 0, -1e10}, {3e10, 5e10, 1e10}},
                      {"far", {1e6, 1e6, 1e6}, {1e6 + 1, 1e6 + 2, 1e6 + 3}}};

// Largest coordinate of a corner in the image, whose edges are at 1; infinite behind the camera.
double largestCoordinate(const FramingView& view, const Box& box, double aspect) {
  const glm::dvec3 forward = glm::normalize(view.target - view.position);
  const glm::dvec3 right = glm::normalize(glm::cross(forward, glm::dvec3(0, 1, 0))), up = glm::cross(right, forward);
  const double tanY = std::tan(kFramingFovDegrees * std::numbers::pi / 360);
  double largest = 0;
  for (int i = 0; i < 8; ++i) {
    const glm::dvec3 corner((i & 1) != 0 ? box.high.x : box.low.x, (i & 2) != 0 ? box.high.y : box.low.y,
                            (i & 4) != 0 ? box.high.z : box.low.z);
    const glm::dvec3 to = corner - view.position;
    const double depth = glm::dot(to, forward);
    if (!(depth > 0)) return INFINITY;
    largest = std::max({largest, std::abs(glm::dot(to, right)) / (depth * tanY * aspect),
                        std::abs(glm::dot(to, up)) / (depth * tanY)});
  }
  return largest;
}

TEST(Framing, ShowsAllCornersOfTheBox) {
  for (const Box& box : kBoxes)
    for (const double aspect : {4.0 / 3, 1.0, 0.3, 4.0})
      EXPECT_NEAR(largestCoordinate(frameBox(box.low, box.high, aspect), box, aspect), 1 - kFramingMargin, 1e-6)
          << box.name << ", aspect " << aspect;
}

TEST(Framing, IsAThreeQuarterViewFromAbove) {
  const FramingView view = frameBox(glm::dvec3(0), glm::dvec3(2), 1);
  EXPECT_EQ(view.target, glm::dvec3(1));
  const glm::dvec3 toCamera = view.position - view.target;
  EXPECT_NEAR(std::atan2(toCamera.x, toCamera.z) * 180 / std::numbers::pi, kFramingAzimuthDegrees, 1e-9);
  EXPECT_NEAR(std::asin(toCamera.y / glm::length(toCamera)) * 180 / std::numbers::pi, kFramingElevationDegrees, 1e-9);
}

}  // namespace
}  // namespace malus::bake
