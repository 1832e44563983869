#include "meshprep/clean/triangulate.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

Polygons polygon(std::vector<glm::dvec3> positions) {
  Polygons polygons;
  polygons.positions = std::move(positions);
  for (std::uint32_t i = 0; i < polygons.positions.size(); ++i) polygons.corners.push_back(i);
  polygons.closeFace();
  return polygons;
}

// Area vector of all triangles: equals the polygon's where nothing is lost, doubled or turned.
glm::dvec3 areaVector(const Mesh& mesh) {
  glm::dvec3 sum(0);
  for (const glm::uvec3& t : mesh.triangles)
    sum += 0.5 * glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]);
  return sum;
}

double totalArea(const Mesh& mesh) {
  double sum = 0;
  for (const glm::uvec3& t : mesh.triangles)
    sum += 0.5 * glm::length(
                     glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]));
  return sum;
}

TEST(Triangulate, ConvexQuadIsAFanFromItsFirstCorner) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), counts);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(counts.polygons, 1u);
  EXPECT_EQ(counts.concave + counts.nonPlanar + counts.crossing + counts.repeatedCorners, 0u);
}

TEST(Triangulate, ArrowIsNotFannedAcrossItsNotch) {
  // The reflex corner is the third: a fan from the first corner would cover ground outside of the polygon.
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}}), counts);
  EXPECT_EQ(counts.concave, 1u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(totalArea(mesh), areaVector(mesh).z, 1e-12);
  EXPECT_NEAR(totalArea(mesh), 0.5, 1e-12);
}

TEST(Triangulate, LongCombInAnyPlaneKeepsItsArea) {
  // A comb with 8 teeth, tilted out of the axes' planes.
  std::vector<glm::dvec3> corners;
  const glm::dvec3 u = glm::normalize(glm::dvec3(1, 2, 2)), v = glm::normalize(glm::dvec3(2, 1, -2));
  const auto add = [&](double x, double y) { corners.push_back(glm::dvec3(5, -3, 7) + x * u + y * v); };
  add(0, 0);
  add(16, 0);
  for (int tooth = 7; tooth >= 0; --tooth) {
    add(2 * tooth + 2, 3);
    add(2 * tooth + 1, 1);
  }
  add(0, 3);
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon(corners), counts);
  EXPECT_EQ(mesh.triangles.size(), corners.size() - 2);
  EXPECT_EQ(counts.concave, 1u);
  EXPECT_EQ(counts.nonPlanar, 0u);
  EXPECT_EQ(counts.crossing, 0u);
  EXPECT_NEAR(totalArea(mesh), glm::length(areaVector(mesh)), 1e-9);
  EXPECT_GT(glm::dot(areaVector(mesh), glm::cross(u, v)), 0);
}

TEST(Triangulate, CornerInTheMiddleOfASideLeavesNoTriangleWithoutArea) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}), counts);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  for (const glm::uvec3& t : mesh.triangles)
    EXPECT_GT(
        glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x])),
        0.1);
  EXPECT_NEAR(areaVector(mesh).z, 2, 1e-12);
}

TEST(Triangulate, BentQuadIsCounted) {
  TriangulateCounts counts;
  triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}}), counts);
  EXPECT_EQ(counts.nonPlanar, 1u);
  EXPECT_EQ(counts.concave, 0u);
}

TEST(Triangulate, BowTieIsCounted) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), counts);
  EXPECT_EQ(counts.concave, 1u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Triangulate, RepeatedCornersAreLeftOutAndCounted) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}), counts);
  EXPECT_EQ(counts.repeatedCorners, 2u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 3}}));
}

TEST(Triangulate, PolygonWithoutAreaStaysAsOneDegenerateTriangle) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}), counts);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

}  // namespace
}  // namespace malus::prep
