// shaders/surfaces/barycentrics.h in single precision against points that are known by construction.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shaders/optics/optics.h"
// clang-format off
#include "shaders/optics/language_begin.h"
namespace malus::f32 {
#include "shaders/surfaces/barycentrics.h"
}
#include "shaders/optics/language_end.h"
// clang-format on

namespace malus {
namespace {

using glm::dvec3;
using glm::vec3;

// Rays toward known points of triangles whose size is from 1e-3 to 1e3 of the distance. Corners and directions are
// rounded to float: the error is a few roundings of the ray's length relative to the height of the triangle.
TEST(Barycentrics, FindThePointThatTheRayIsAimedAt) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1), side(-1, 1), exponent(-3, 3);
  const auto point = [&] { return dvec3(side(random), side(random), side(random)); };
  int checked = 0;
  for (int draw = 0; draw < 20000; ++draw) {
    const double size = std::pow(10.0, exponent(random));
    const dvec3 from = point() * 3.0;
    const dvec3 p0(vec3(point() * size)), p1(vec3(point() * size)), p2(vec3(point() * size));
    double b1 = unit(random), b2 = unit(random);
    if (b1 + b2 > 1) b1 = 1 - b1, b2 = 1 - b2;
    const dvec3 start{vec3(from)};
    const dvec3 target = p0 * (1 - b1 - b2) + p1 * b1 + p2 * b2, way = target - start;
    const dvec3 d = glm::normalize(way), across = glm::cross(p1 - p0, p2 - p0);
    const double cosine = std::abs(glm::dot(d, glm::normalize(across)));
    if (cosine < 0.1) continue;
    const double longest = std::max({glm::length(p1 - p0), glm::length(p2 - p0), glm::length(p2 - p1)});
    const double height = glm::length(across) / longest;
    const double reach = glm::length(way) + longest;
    const double bound = 16 * 0x1p-24 * reach / (height * cosine);
    if (bound > 0.1) continue;  // slivers far away
    ++checked;
    const auto found = f32::barycentricCoordinates(vec3(start), vec3(d), vec3(p0), vec3(p1), vec3(p2));
    ASSERT_NEAR(found.b1, b1, bound) << draw;
    ASSERT_NEAR(found.b2, b2, bound) << draw;
  }
  EXPECT_GT(checked, 10000);
}

TEST(Barycentrics, StayInsideTheTriangle) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> side(-1, 1);
  const auto point = [&] { return vec3(side(random), side(random), side(random)); };
  for (int draw = 0; draw < 20000; ++draw) {
    const auto b = f32::barycentricCoordinates(point() * 3.0f, glm::normalize(point()), point(), point(), point());
    ASSERT_GE(b.b1, 0);
    ASSERT_GE(b.b2, 0);
    ASSERT_LE(b.b1 + b.b2, 1);
  }
}

// A ray in the plane of a triangle, and triangles without area.
TEST(Barycentrics, AreFiniteWithoutAnArea) {
  const vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  for (const auto& found : {f32::barycentricCoordinates(vec3(-1, 0, 0), b, a, b, c),
                            f32::barycentricCoordinates(vec3(0, 0, 1), vec3(0, 0, -1), a, a, a),
                            f32::barycentricCoordinates(vec3(0, 0, 1), vec3(0, 0, -1), a, b, b)}) {
    EXPECT_TRUE(std::isfinite(found.b1) && std::isfinite(found.b2));
    EXPECT_GE(found.b1, 0);
    EXPECT_LE(found.b1 + found.b2, 1);
  }
}

}  // namespace
}  // namespace malus
