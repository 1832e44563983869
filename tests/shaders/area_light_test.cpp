// Solid angles of triangles and rectangles and their samples, against closed forms, in float and double.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "shaders/optics/optics.h"

namespace malus {
namespace {

using glm::dvec3;

constexpr double kPi = std::numbers::pi;

// Vector irradiance of a polygon of radiance 1 as seen from the origin: 1/2 sum of angle times unit normal over its
// sides. Source: Lambert, Photometria, 1760; Baum et al., SIGGRAPH 1989.
dvec3 vectorIrradiance(const std::vector<dvec3>& corners) {
  dvec3 sum(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
    const dvec3 across = glm::cross(a, b);
    const double sine = glm::length(across);
    if (sine > 0) sum += across * (std::atan2(sine, glm::dot(a, b)) / sine / 2);
  }
  return sum;
}

struct Light {
  dvec3 corner, u, v;
  bool isRectangle;
  std::vector<dvec3> corners() const {
    if (isRectangle) return {corner, corner + u, corner + u + v, corner + v};
    return {corner, corner + u, corner + v};
  }
};

struct F32 {
  using real = float;
  using Vec = glm::vec3;
  static f32::AreaSample sample(const Light& l, double u, double v) {
    const Vec c(l.corner), a(l.u), b(l.v), n = f32::cross3(a, b);
    return l.isRectangle ? f32::sampleRectangleLight(c, a, b, n, static_cast<float>(u), static_cast<float>(v))
                         : f32::sampleTriangleLight(c, a, b, n, static_cast<float>(u), static_cast<float>(v));
  }
};
struct F64 {
  using real = double;
  static f64::AreaSample sample(const Light& l, double u, double v) {
    const dvec3 n = f64::cross3(l.u, l.v);
    return l.isRectangle ? f64::sampleRectangleLight(l.corner, l.u, l.v, n, u, v)
                         : f64::sampleTriangleLight(l.corner, l.u, l.v, n, u, v);
  }
};

// Mean of direction times measure over a grid of the unit square: the vector irradiance.
template <class F>
dvec3 sampledIrradiance(const Light& light, int side) {
  dvec3 sum(0);
  for (int i = 0; i < side; ++i)
    for (int j = 0; j < side; ++j) {
      const auto s = F::sample(light, (i + 0.5) / side, (j + 0.5) / side);
      sum += glm::normalize(dvec3(s.toLight)) * static_cast<double>(s.measure);
    }
  return sum / static_cast<double>(side * side);
}

// The irradiance has either sign, which depends on the order of the corners.
void expectIrradiance(const dvec3& sampled, dvec3 expected, double tolerance, const char* what) {
  if (glm::dot(sampled, expected) < 0) expected = -expected;
  EXPECT_LE(glm::length(sampled - expected), tolerance * glm::length(expected)) << what;
}

std::vector<Light> ordinaryLights() {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1, 1);
  std::vector<Light> lights;
  for (int i = 0; i < 200; ++i) {
    const dvec3 u(uniform(random), uniform(random), uniform(random)),
        w(uniform(random), uniform(random), uniform(random));
    const dvec3 corner = 2.0 * dvec3(uniform(random), uniform(random), uniform(random));
    const dvec3 v = glm::normalize(glm::cross(u, w)) * (0.2 + std::abs(uniform(random)));
    if (std::abs(glm::dot(glm::normalize(glm::cross(u, v)), corner)) < 0.05) continue;
    lights.push_back({corner, u, v, true});
    lights.push_back({corner, u, w, false});
  }
  return lights;
}

TEST(AreaLightTest, AnglesAreThoseOfTheLibrary) {
  for (int i = 0; i <= 1000; ++i) {
    const double angle = kPi * i / 1000;
    EXPECT_NEAR(f64::angleOfPoint(3 * std::cos(angle), 3 * std::sin(angle)), angle, 2e-15);
    const double sine = -1 + i / 500.0;
    EXPECT_NEAR(f64::arcSine(sine), std::asin(sine), 2e-15);
    EXPECT_NEAR(f32::arcSine(static_cast<float>(sine)), std::asin(static_cast<float>(sine)), 5e-7);
  }
  EXPECT_NEAR(f32::angleOfPoint(1, 1e-9f), 1e-9, 1e-15);
}

TEST(AreaLightTest, SolidAnglesOfKnownTriangles) {
  const auto solidAngle = [](const dvec3& a, const dvec3& b, const dvec3& c) {
    return f64::sphericalTriangle(a, b - a, c - a, glm::cross(b - a, c - a)).solidAngle;
  };
  EXPECT_NEAR(solidAngle({1, 0, 0}, {0, 2, 0}, {0, 0, 3}), kPi / 2, 1e-14);
  EXPECT_NEAR(solidAngle({1, 0, 1e-9}, {-0.5, std::sqrt(0.75), 1e-9}, {-0.5, -std::sqrt(0.75), 1e-9}), 2 * kPi, 2e-8);
  // Area over distance^2 of a tiny one, with full relative precision in float.
  for (const float size : {1e-3f, 1e-6f, 1e-9f}) {
    const glm::vec3 corner(0, 0, 1), u(size, 0, 0), v(0, size, 0);
    const float found = f32::sphericalTriangle(corner, u, v, f32::cross3(u, v)).solidAngle;
    EXPECT_NEAR(found / (size * size / 2), 1, 2 * size * size + 1e-6) << size;
  }
}

TEST(AreaLightTest, SamplesGiveTheIrradianceOfTheClosedForm) {
  for (const Light& light : ordinaryLights()) {
    const dvec3 expected = vectorIrradiance(light.corners());
    expectIrradiance(sampledIrradiance<F64>(light, 40), expected, 3e-3, "double");
    expectIrradiance(sampledIrradiance<F32>(light, 40), expected, 3e-3, "float");
  }
}

// The error of the midpoint rule over the stratified square falls as 1/N^2 per axis, at least as 1/N.
TEST(AreaLightTest, StratifiedSamplesConverge) {
  for (const Light& light : ordinaryLights()) {
    const dvec3 expected = vectorIrradiance(light.corners());
    for (const int side : {4, 8, 16, 32})
      expectIrradiance(sampledIrradiance<F64>(light, side), expected, 0.5 / side, "double");
  }
}

TEST(AreaLightTest, SamplesAreOnTheLight) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> uniform(0, 1);
  for (const Light& light : ordinaryLights())
    for (int i = 0; i < 50; ++i) {
      const auto s = F64::sample(light, uniform(random), uniform(random));
      const dvec3 n = glm::cross(light.u, light.v), p = s.toLight - light.corner;
      const double a = glm::dot(glm::cross(p, light.v), n) / glm::dot(n, n),
                   b = glm::dot(glm::cross(light.u, p), n) / glm::dot(n, n);
      EXPECT_GE(std::min(a, b), -1e-7);
      EXPECT_LE(light.isRectangle ? std::max(a, b) : a + b, 1 + 1e-7);
      EXPECT_LE(std::abs(glm::dot(p, n)), 1e-9);
    }
}

// Tiny, distant, thin, grazing and near-hemisphere lights: float agrees with the closed form in double.
TEST(AreaLightTest, HardLightsAreStableInFloat) {
  std::vector<Light> lights;
  for (const bool isRectangle : {false, true}) {
    for (const double size : {1e-7, 1e-5, 1e-3, 3e-3, 1e-2, 3e-2})
      lights.push_back({{0.3, -0.2, 1}, {size, 0, 0}, {0, size, 0}, isRectangle});  // tiny
    for (const double width : {1e-6, 1e-4, 1e-3, 1e-2})
      lights.push_back({{-0.5, 0.1, 1}, {1, 0, 0}, {0, width, 0}, isRectangle});  // thin
    for (const double height : {1e-1, 1e-2, 1e-3, 1e-4, 1e-5})
      lights.push_back({{-1, -1.5, height}, {4, 0, 0}, {0, 4.5, 0}, isRectangle});  // nearly a hemisphere
    for (const double distance : {10., 1e3, 1e5})
      lights.push_back({{distance, 0, 0.7}, {0, 1, 0}, {0.6, 0, 0.8}, isRectangle});  // distant
    for (const double height : {1e-1, 1e-2, 1e-3})
      lights.push_back({{2, 1, height}, {3, 0, 0}, {0, 3, 0}, isRectangle});  // beside, grazing
  }
  for (const Light& light : lights) {
    const dvec3 closed = vectorIrradiance(light.corners());
    const dvec3 fine = sampledIrradiance<F64>(light, 100);
    std::ostringstream what;
    what << light.corner.x << ' ' << light.corner.z << ' ' << light.u.x << ' ' << light.v.y << ' ' << light.isRectangle;
    expectIrradiance(fine, closed, 4e-3, what.str().c_str());
    // 2e-6 of its size away from a triangle, float loses the direction of a corner that the plane hides.
    const bool isClosest = light.corner.z == 1e-5;
    expectIrradiance(sampledIrradiance<F32>(light, 100), fine, isClosest ? 1e-2 : 1e-3, what.str().c_str());
  }
}

TEST(AreaLightTest, ImportanceIsZeroOnlyWhereNothingArrives) {
  const auto importance = [](const dvec3& p, const dvec3& n, double spread) {
    return f64::lightImportance(p, n, {0, 0, 2}, 0.5, {0, 0, -1}, spread, 3);
  };
  EXPECT_NEAR(f64::lightImportance(dvec3(0), {0, 0, 1}, {0, 0, 2}, 1e-9, {0, 0, -1}, 1, 3), 3.0 / 4, 1e-6);
  EXPECT_EQ(importance({0, 0, 0}, {0, 0, -1}, 1), 0);    // behind the receiver
  EXPECT_EQ(importance({0, 0, 4}, {0, 0, -1}, 1), 0);    // behind the light
  EXPECT_GT(importance({0, 0, 4}, {0, 0, -1}, -1), 0);   // which emits to both sides
  EXPECT_GT(importance({0, 0, 1.9}, {0, 0, -1}, 1), 0);  // between the lights
  EXPECT_GT(importance({0, 0, 1.6}, {0, 0, 1}, 1), 0);
  EXPECT_GT(importance({3, 0, 2.2}, {0, 0, 1}, 1), 0);  // part of the sphere is above the horizon
}

TEST(AreaLightTest, CosineDirectionsHaveTheirDensity) {
  // The mean of the direction is 2/3 of the normal.
  for (const dvec3 n : {dvec3(0, 0, 1), dvec3(0, 0, -1), glm::normalize(dvec3(1, -2, 3))}) {
    dvec3 sum(0);
    for (int i = 0; i < 100; ++i)
      for (int j = 0; j < 100; ++j) sum += f64::cosineDirection(n, (i + 0.5) / 100, (j + 0.5) / 100);
    EXPECT_LE(glm::length(sum / 1e4 - n * (2.0 / 3)), 1e-4);
  }
}

TEST(AreaLightTest, OctahedralSolidAnglesAddUpToTheSphere) {
  constexpr int kSide = 400;
  double sum = 0;
  for (int i = 0; i < kSide; ++i)
    for (int j = 0; j < kSide; ++j)
      sum += f64::octahedralSolidAngle(f64::directionFromOctahedral((i + 0.5) / kSide, (j + 0.5) / kSide));
  EXPECT_NEAR(sum / (kSide * kSide), 4 * kPi, 1e-4);
}

TEST(AreaLightTest, RadicalInverse) {
  EXPECT_EQ(f32::radicalInverse(0), 0.0f);
  EXPECT_EQ(f32::radicalInverse(1), 0.5f);
  EXPECT_EQ(f32::radicalInverse(6), 0.375f);
}

}  // namespace
}  // namespace malus
