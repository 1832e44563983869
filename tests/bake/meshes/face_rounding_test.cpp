// Distances at which rays start from a face, and the bounds on them that SCENE.md states.
#include "bake/meshes/face_rounding.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace malus::bake {
namespace {

TEST(FaceRounding, StartsAreWithinTheStatedBounds) {
  std::mt19937 random(15);
  std::uniform_real_distribution<double> unit(0, 1);
  const auto point = [&](double size) { return (glm::dvec3(unit(random), unit(random), unit(random)) - 0.5) * size; };
  double closest = 0;  // share of the bound that a face reaches
  for (int i = 0; i < 5000; ++i) {
    const double size = std::pow(10.0, 6 * unit(random) - 3);
    const glm::dvec3 origin = i % 2 == 0 ? glm::dvec3(0) : point(100 * size);
    // Corners of the box as often as points inside.
    const auto corner = [&] {
      const glm::dvec3 p = point(size);
      return origin + (i % 3 == 0 ? glm::sign(p) * 0.5 * size : p);
    };
    const Corners face = {corner(), corner(), corner()};
    const double largest = largestStart(face, origin);
    const double b1 = unit(random), b2 = (1 - b1) * unit(random);
    const FaceRounding inside = faceRounding(face, origin, b1, b2);
    EXPECT_LE(inside.start, largest * (1 + 1e-9));
    EXPECT_LE(inside.hit, inside.start);
    const double bound = boundStart(origin - 0.5 * size, origin + 0.5 * size, origin);
    EXPECT_LE(largest, bound);
    EXPECT_LE(bound, 2.1e-6 * size + 6e-7 * glm::length(origin));
    closest = std::max(closest, largest / bound);
  }
  EXPECT_GT(closest, 0.5);
}

// Without an origin, at the middle of the diagonal of a square in the plane of the origin: 8 roundings of half a side.
TEST(FaceRounding, IsThatOfTheShaders) {
  const Corners face = {glm::dvec3(-1, -1, 0), glm::dvec3(1, -1, 0), glm::dvec3(-1, 1, 0)};
  const FaceRounding middle = faceRounding(face, glm::dvec3(0), 0.5, 0.5);
  EXPECT_EQ(middle.hit, 0);
  EXPECT_NEAR(middle.start, 8 * 0x1p-24, 1e-12);
  const FaceRounding none = faceRounding({face[0], face[0], face[1]}, glm::dvec3(0), 0, 0);
  EXPECT_EQ(none.hit, 0);
  EXPECT_EQ(none.start, 0);
}

}  // namespace
}  // namespace malus::bake
