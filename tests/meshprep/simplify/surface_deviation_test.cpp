#include "meshprep/simplify/surface_deviation.h"

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

Mesh triangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  Mesh mesh;
  mesh.positions = {a, b, c};
  mesh.triangles = {{0, 1, 2}};
  return mesh;
}

// n by n quads of the unit square, at height z(x, y).
template <class Height>
Mesh sheet(std::uint32_t n, Height z) {
  Mesh mesh;
  for (std::uint32_t i = 0; i <= n; ++i)
    for (std::uint32_t j = 0; j <= n; ++j) {
      const double x = static_cast<double>(i) / n, y = static_cast<double>(j) / n;
      mesh.positions.emplace_back(x, y, z(x, y));
    }
  for (std::uint32_t i = 0; i < n; ++i)
    for (std::uint32_t j = 0; j < n; ++j) {
      const std::uint32_t a = i * (n + 1) + j, b = a + n + 1;
      mesh.triangles.emplace_back(a, b, b + 1);
      mesh.triangles.emplace_back(a, b + 1, a + 1);
    }
  return mesh;
}

TEST(SurfaceDeviation, DistanceToATriangleByRegion) {
  const TriangleCorners t = {glm::dvec3(0), glm::dvec3(2, 0, 0), glm::dvec3(0, 2, 0)};
  EXPECT_DOUBLE_EQ(distanceToTriangle({0.5, 0.5, -3}, t), 3);          // face
  EXPECT_DOUBLE_EQ(distanceToTriangle({1, -2, 0}, t), 2);              // edge
  EXPECT_DOUBLE_EQ(distanceToTriangle({2, 2, 0}, t), std::sqrt(2.0));  // hypotenuse
  EXPECT_DOUBLE_EQ(distanceToTriangle({-3, -4, 0}, t), 5);             // corner
  const TriangleCorners line = {glm::dvec3(0), glm::dvec3(1, 0, 0), glm::dvec3(2, 0, 0)};
  EXPECT_DOUBLE_EQ(distanceToTriangle({3, 0, 1}, line), std::sqrt(2.0));  // no area
}

TEST(SurfaceDeviation, NearestAgreesWithAllTriangles) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-1, 2);
  const Mesh mesh = sheet(13, [](double x, double y) { return std::sin(9 * x) * std::cos(7 * y); });
  const Surface surface(mesh);
  for (int i = 0; i < 300; ++i) {
    const glm::dvec3 p(uniform(random), uniform(random), uniform(random));
    double smallest = 1e9;
    for (std::uint32_t t = 0; t < surface.triangleCount(); ++t)
      smallest = std::min(smallest, distanceToTriangle(p, surface.triangle(t)));
    EXPECT_EQ(surface.nearest(p).distance, smallest);
    std::size_t within = 0, expected = 0;
    surface.forEachWithin(p, 1.3 * smallest, [&](std::uint32_t) { ++within; });
    for (std::uint32_t t = 0; t < surface.triangleCount(); ++t)
      expected += distanceToTriangle(p, surface.triangle(t)) <= 1.3 * smallest ? 1u : 0u;
    EXPECT_EQ(within, expected);
  }
}

TEST(SurfaceDeviation, ParallelPlanesAndTheirTessellations) {
  const Mesh fine = sheet(40, [](double, double) { return 0.25; }),
             coarse = sheet(3, [](double, double) { return 0.0; });
  for (const double bound : {maxDistance(fine, Surface(coarse), 1e-9), maxDistance(coarse, Surface(fine), 1e-9)}) {
    EXPECT_GE(bound, 0.25);
    EXPECT_LE(bound, 0.25 * 1.0101);
  }
  const Mesh same = sheet(7, [](double, double) { return 0.0; });
  EXPECT_LT(maxDistance(same, Surface(coarse), 1e-12), 1e-12);
  EXPECT_LT(maxDistance(coarse, Surface(same), 1e-12), 1e-12);
}

TEST(SurfaceDeviation, MaximumInsideOfATriangle) {
  // A roof over the base of a triangle: all corners of the base are on the roof, its deepest points are not.
  const Mesh base = triangle({0, 0, 0}, {4, 0, 0}, {2, 4, 0});
  Mesh roof;
  roof.positions = {{0, 0, 0}, {4, 0, 0}, {2, 4, 0}, {2, 1.5, 1}};
  roof.triangles = {{0, 1, 3}, {1, 2, 3}, {2, 0, 3}};
  EXPECT_NEAR(maxDistance(roof, Surface(base), 1e-9), 1, 1e-12);  // the ridge point, exact because it is a vertex

  // The point below the ridge point is not the farthest; compare with a fine sample of the base.
  const Surface roofSurface(roof);
  double sampled = 0;
  for (int i = 0; i <= 400; ++i)
    for (int j = 0; i + j <= 400; ++j) {
      const double u = i / 400.0, v = j / 400.0;
      sampled = std::max(sampled, roofSurface.nearest({4 * u + 2 * v, 4 * v, 0}).distance);
    }
  const double bound = maxDistance(base, roofSurface, 1e-6);
  EXPECT_GE(bound, sampled);
  EXPECT_LE(bound, 1.02 * sampled + 1e-3);
}

TEST(SurfaceDeviation, IsAnUpperBoundOfRandomSheets) {
  std::mt19937 random(2);
  std::uniform_real_distribution<double> uniform(0, 0.1), unit(0, 1);
  for (int round = 0; round < 10; ++round) {
    const Mesh a = sheet(9, [&](double, double) { return uniform(random); });
    const Surface b(sheet(5, [&](double, double) { return uniform(random); }));
    const double bound = maxDistance(a, b, 1e-6);
    double sampled = 0;
    for (const glm::uvec3& t : a.triangles)
      for (int i = 0; i < 50; ++i) {
        double u = unit(random), v = unit(random);
        if (u + v > 1) u = 1 - u, v = 1 - v;
        const glm::dvec3 p =
            a.positions[t.x] + u * (a.positions[t.y] - a.positions[t.x]) + v * (a.positions[t.z] - a.positions[t.x]);
        sampled = std::max(sampled, b.nearest(p).distance);
      }
    EXPECT_GE(bound, sampled);
    EXPECT_LE(bound, 1.1 * sampled);  // the sample misses the maximum by a few percent
  }
}

TEST(SurfaceDeviation, NormalOfATiltedSheet) {
  const Mesh flat = sheet(4, [](double, double) { return 0.0; });
  const Mesh tilted = sheet(4, [](double x, double) { return x * std::tan(0.2); });
  EXPECT_NEAR(maxNormalDeviation(flat, Surface(tilted), 0), 0.2 * 180 / std::numbers::pi, 1e-6);
  EXPECT_NEAR(maxNormalDeviation(flat, Surface(flat), 0), 0, 1e-6);
}

}  // namespace
}  // namespace malus::prep
