#include "meshprep/clean/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "meshprep/clean/duplicate_faces.h"
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

// Area vector of all triangles: equals that of the polygon if none is missing, duplicated or flipped.
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

TEST(Triangulate, MakesAFanOfAConvexQuad) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}), counts);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(counts.polygons, 1u);
  EXPECT_EQ(counts.concave + counts.nonPlanar + counts.crossing + counts.repeatedCorners, 0u);
}

// A face that is given again from another corner, or from behind, has the same triangles, also with separate vertices.
TEST(Triangulate, CutsCopiesOfAFaceAlike) {
  const std::vector<glm::dvec3> quad = {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},
                                arrow = {{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}},
                                pentagon = {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}};
  for (const std::vector<glm::dvec3>& corners : {quad, arrow, pentagon})
    for (const bool reversed : {false, true})
      for (std::uint32_t shift = 0; shift < corners.size(); ++shift) {
        const auto n = static_cast<std::uint32_t>(corners.size());
        Polygons polygons = polygon(corners);
        for (std::uint32_t i = 0; i < n; ++i) {
          const std::uint32_t corner = (reversed ? n - i + shift : i + shift) % n;
          polygons.corners.push_back(n + corner);
        }
        polygons.closeFace();
        polygons.positions.insert(polygons.positions.end(), corners.begin(), corners.end());
        TriangulateCounts counts;
        Mesh mesh = triangulate(polygons, counts);
        ASSERT_EQ(mesh.triangles.size(), 2 * (n - 2));
        EXPECT_NEAR(areaVector(mesh).z, reversed ? 0 : totalArea(mesh), 1e-12);
        for (glm::uvec3& t : mesh.triangles)
          for (int k = 0; k < 3; ++k) t[k] %= n;
        const DuplicateFaces found = dropDuplicateFaces(mesh, true);
        EXPECT_EQ(reversed ? found.opposite.count : found.same.count, n - 2) << reversed << " " << shift;
        EXPECT_EQ(mesh.triangles.size(), n - 2);
      }
}

// Many faces are cut in blocks by several threads. The triangles of a face are those of the face alone.
TEST(Triangulate, CutsManyFacesAsEachAlone) {
  const std::vector<std::vector<glm::dvec3>> shapes = {
      {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},              // convex
      {{2, 0, 0}, {2, 1, 0}, {0, 1, 0}, {0, 0, 0.1}},            // not planar
      {{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}},           // concave
      {{0, 0, 0}, {0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}},   // with a repeated corner
      {{0, 0, 0}, {2, 0, 0}, {3, 1, 0}, {1, 2, 0}, {-1, 1, 0}},  // convex, of five corners
      {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}},                         // triangle
      {{0, 0, 0}, {1, 0, 0}},                                    // too few corners
      {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 0, 0}},              // to and fro: without area
  };
  constexpr std::size_t kFaces = 50016;
  Polygons all;
  std::vector<glm::uvec3> expected;
  for (std::size_t f = 0; f < kFaces; ++f) {
    const auto first = static_cast<std::uint32_t>(all.positions.size());
    std::vector<glm::dvec3> corners = shapes[f % shapes.size()];
    // Every face is elsewhere, apart from the last ones, which are copies of the first ones.
    for (glm::dvec3& p : corners) p.x += 8 * static_cast<double>(f < kFaces - 16 ? f : f - (kFaces - 16));
    TriangulateCounts counts;
    for (const glm::uvec3& t : triangulate(polygon(corners), counts).triangles) expected.push_back(t + first);
    for (std::uint32_t i = 0; i < corners.size(); ++i) all.corners.push_back(first + i);
    all.positions.insert(all.positions.end(), corners.begin(), corners.end());
    all.closeFace();
  }
  TriangulateCounts counts;
  EXPECT_EQ(triangulate(all, counts).triangles, expected);
  EXPECT_EQ(counts.fewCorners, kFaces / shapes.size());
  EXPECT_EQ(counts.repeatedCorners, kFaces / shapes.size());
}

TEST(Triangulate, CutsFacesOfOtherCornersByThemselves) {
  // The same positions in another order: a quad that crosses itself.
  Polygons polygons = polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}});
  polygons.corners.insert(polygons.corners.end(), {0, 2, 1, 3});
  polygons.closeFace();
  TriangulateCounts counts;
  EXPECT_EQ(triangulate(polygons, counts).triangles.size(), 4u);
  EXPECT_EQ(counts.crossing, 1u);
}

TEST(Triangulate, ClipsEarsOfAnArrow) {
  // The third corner is reflex: a fan from the first corner would leave the polygon.
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}}), counts);
  EXPECT_EQ(counts.concave, 1u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_NEAR(totalArea(mesh), areaVector(mesh).z, 1e-12);
  EXPECT_NEAR(totalArea(mesh), 0.5, 1e-12);
}

TEST(Triangulate, KeepsTheAreaOfACombInAnyPlane) {
  // A comb with 8 teeth in a tilted plane.
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

TEST(Triangulate, AvoidsZeroAreaAtCollinearCorners) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 2, 0}}), counts);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  for (const glm::uvec3& t : mesh.triangles)
    EXPECT_GT(
        glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x])),
        0.1);
  EXPECT_NEAR(areaVector(mesh).z, 2, 1e-12);
}

TEST(Triangulate, CountsNonPlanarQuads) {
  TriangulateCounts counts;
  triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 1, 0.2}, {0, 1, 0}}), counts);
  EXPECT_EQ(counts.nonPlanar, 1u);
  EXPECT_EQ(counts.concave, 0u);
}

TEST(Triangulate, CountsSelfCrossingPolygons) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}), counts);
  EXPECT_EQ(counts.concave, 1u);
  EXPECT_EQ(mesh.triangles.size(), 2u);
}

TEST(Triangulate, DropsAndCountsRepeatedCorners) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 0, 0}}), counts);
  EXPECT_EQ(counts.repeatedCorners, 2u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 3}}));
}

TEST(Triangulate, MakesOneDegenerateTriangleOfAPolygonWithoutArea) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygon({{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}), counts);
  EXPECT_EQ(mesh.triangles.size(), 1u);
}

// Expects the area vector of the polygon, and its number of triangles.
void expectWhole(const Polygons& polygons) {
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygons, counts);
  EXPECT_EQ(mesh.triangles.size(), polygons.corners.size() - 2);
  EXPECT_EQ(counts.crossing, 0u);
  EXPECT_GT(totalArea(mesh), 0);
  EXPECT_NEAR(totalArea(mesh) / glm::length(areaVector(mesh)), 1, 1e-9);
  for (const glm::uvec3& t : mesh.triangles)
    EXPECT_NE(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x]),
              glm::dvec3(0));
}

// Returns the outline r(angle) with n corners.
template <class Radius>
Polygons outline(int n, Radius radius) {
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < n; ++i) {
    const double angle = 2 * 3.14159265358979323846 * i / n;
    corners.emplace_back(radius(angle) * std::cos(angle), radius(angle) * std::sin(angle), 0);
  }
  return polygon(corners);
}

TEST(Triangulate, ClipsSidesWithCollinearCorners) {
  // Every corner ends a side with collinear corners, so that no fan is valid; also with one side without.
  for (const std::array<int, 3>& parts : {std::array{3, 3, 3}, {3, 4, 1}, {1, 3, 4}, {4, 1, 3}, {3000, 2000, 1000}}) {
    const std::array<glm::dvec3, 4> ends = {glm::dvec3(0), {4, 1, 2}, {1, 5, 3}, glm::dvec3(0)};
    std::vector<glm::dvec3> corners;
    for (std::size_t side = 0; side < 3; ++side)
      for (int i = 0; i < parts[side]; ++i)
        corners.push_back(ends[side] + (ends[side + 1] - ends[side]) * (static_cast<double>(i) / parts[side]));
    for (std::size_t turn = 0; turn < std::min<std::size_t>(corners.size(), 10); ++turn) {
      expectWhole(polygon(corners));
      std::rotate(corners.begin(), corners.begin() + 1, corners.end());
    }
  }
}

TEST(Triangulate, MakesFansOfLargeConvexFaces) {
  for (const int n : {5, 100, 10000, 300000}) {
    const Polygons polygons = outline(n, [](double) { return 2.0; });
    expectWhole(polygons);
    TriangulateCounts counts;
    EXPECT_EQ(triangulate(polygons, counts).triangles[1], glm::uvec3(0, 2, 3)) << n;
    EXPECT_EQ(counts.concave, 0u);
  }
}

TEST(Triangulate, ClipsSmoothConcaveOutlines) {
  // Each ear is smaller than the rounding error of the polygon's area.
  expectWhole(outline(50000, [](double angle) { return 1 + 0.9 * std::cos(2 * angle); }));
  // Two bows that nearly touch: no corner turns right by more than 4e-5, and a fan would leave the polygon.
  std::vector<glm::dvec3> corners;
  for (int i = 0; i < 10000; ++i) {
    const double x = -1 + i / 4999.5;
    corners.emplace_back(x, -0.01 - 0.1 * x * x, 0);
  }
  for (int i = 0; i < 10000; ++i) corners.push_back(-corners[static_cast<std::size_t>(i)]);
  TriangulateCounts counts;
  triangulate(polygon(corners), counts);
  EXPECT_EQ(counts.concave, 1u);
  expectWhole(polygon(corners));
}

TEST(Triangulate, ClipsManyConcaveFaces) {
  Polygons polygons;
  const Polygons one = outline(70, [](double angle) { return 2 + std::sin(30 * angle); });
  for (int i = 0; i < 1000; ++i) {
    for (const glm::dvec3& p : one.positions) {
      polygons.corners.push_back(static_cast<std::uint32_t>(polygons.positions.size()));
      polygons.positions.push_back(p);
    }
    polygons.closeFace();
  }
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygons, counts);
  EXPECT_EQ(counts.concave, 1000u);
  EXPECT_EQ(mesh.triangles.size(), 68000u);
  EXPECT_NEAR(totalArea(mesh), 1000 * totalArea(triangulate(one, counts)), 1e-6);
}

TEST(Triangulate, RefusesFacesThatTakeTooLong) {
  // A comb: each candidate that is not an ear contains another tooth.
  std::vector<glm::dvec3> comb = {{0, 0, 0}, {400000, 0, 0}};
  for (int tooth = 200000 - 1; tooth >= 0; --tooth) {
    comb.emplace_back(2 * tooth + 2, 3, 0);
    comb.emplace_back(2 * tooth + 1, 1, 0);
  }
  comb.emplace_back(0, 3, 0);
  Polygons polygons = polygon(comb);
  TriangulateCounts counts;
  const std::string error = test::errorMessage([&] { triangulate(polygons, counts); });
  EXPECT_TRUE(test::contains(error, "face 0: ") && test::contains(error, "400003 corners")) << error;
  polygons.faceLocations = {7};
  EXPECT_TRUE(test::contains(test::errorMessage([&] { triangulate(polygons, counts); }), "face 0, line 7: "));
  polygons.locationsAreBytes = true;
  EXPECT_TRUE(test::contains(test::errorMessage([&] { triangulate(polygons, counts); }), "face 0, byte 7: "));
}

TEST(Triangulate, KeepsAttributes) {
  // A concave face whose first corner is repeated, and a triangle.
  Polygons polygons;
  polygons.positions = {{0, 0, 0}, {2, -1, 0}, {0.5, 0, 0}, {2, 1, 0}};
  polygons.corners = {0, 0, 1, 2, 3, 1, 3, 2};
  polygons.firstCorner = {0, 5, 8};
  polygons.smoothingGroups = {4, 9};
  for (std::size_t i = 0; i < 8; ++i) polygons.cornerNormals.emplace_back(static_cast<float>(i), 0, 1);
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygons, counts);
  ASSERT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.sourceVertices, (std::vector<std::uint32_t>{0, 1, 2, 3}));
  EXPECT_EQ(mesh.sourceFaces, (std::vector<std::uint32_t>{0, 0, 1}));
  EXPECT_EQ(mesh.smoothingGroups, (std::vector<std::uint32_t>{4, 4, 9}));
  ASSERT_EQ(mesh.cornerNormals.size(), 9u);
  for (std::size_t t = 0; t < 3; ++t)
    for (int k = 0; k < 3; ++k) {
      // Which corner of the face it is: each vertex but the first is there once in each face.
      const auto normal = static_cast<std::size_t>(mesh.cornerNormals[3 * t + static_cast<std::size_t>(k)].x);
      EXPECT_EQ(polygons.corners[normal], mesh.triangles[t][k]);
      EXPECT_EQ(normal >= 5, t == 2);
    }

  // Normals of vertices are used if corners have none.
  polygons.cornerNormals.clear();
  polygons.smoothingGroups.clear();
  polygons.normals = {{1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {4, 0, 0}};
  const Mesh byVertex = triangulate(polygons, counts);
  EXPECT_TRUE(byVertex.smoothingGroups.empty());
  ASSERT_EQ(byVertex.cornerNormals.size(), 9u);
  EXPECT_EQ(byVertex.cornerNormals[6], glm::vec3(2, 0, 0));
  EXPECT_EQ(byVertex.cornerNormals[7], glm::vec3(4, 0, 0));
  polygons.normals.clear();
  EXPECT_TRUE(triangulate(polygons, counts).cornerNormals.empty());
}

}  // namespace
}  // namespace malus::prep
