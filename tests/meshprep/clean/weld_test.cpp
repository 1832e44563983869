#include "meshprep/clean/weld.h"

#include <limits>

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::errorMessage;

TEST(Weld, JoinsEqualPositions) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(weld(mesh, 0).joined.count, 2u);
  EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 3, 2}}));
}

TEST(Weld, TreatsNegativeZeroAsZero) {
  Mesh mesh;
  mesh.positions = {{0.0, 1, 2}, {-0.0, 1, 2}};
  EXPECT_EQ(weld(mesh, 0).joined.count, 1u);
}

TEST(Weld, SeparatesAdjacentDoubles) {
  Mesh mesh;
  mesh.positions = {{1, 0, 0}, {std::nextafter(1.0, 2.0), 0, 0}, {5, 0, 0}, {5, 5, 0}};
  mesh.triangles = {{0, 2, 3}, {1, 3, 2}};
  EXPECT_EQ(weld(mesh, 0).joined.count, 0u);
  EXPECT_EQ(weld(mesh, 1e-12).joined.count, 1u);
}

TEST(Weld, JoinsTheNearestAcrossCells) {
  Mesh mesh;
  mesh.positions = {{0.99, 0, 0}, {2.2, 0, 0}, {1.8, 0, 0}, {-1e-9, -1e-9, -1e-9}, {1e-9, 1e-9, 1e-9}};
  mesh.triangles = {{2, 3, 4}, {0, 1, 3}};
  EXPECT_EQ(weld(mesh, 0.98).joined.count, 2u);
  // The third joins the second (0.4 away), not the first (0.81 away); the last two join across the corner of a cell.
  EXPECT_EQ(mesh.positions.size(), 3u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(1, 2, 2));
}

TEST(Weld, DoesNotCollapseChains) {
  Mesh mesh;
  for (int i = 0; i < 11; ++i) mesh.positions.emplace_back(i * 0.6, 0, 0);
  for (std::uint32_t i = 0; i + 2 < 11; ++i) mesh.triangles.emplace_back(i, i + 1, i + 2);
  EXPECT_EQ(weld(mesh, 1.0).joined.count, 5u);
  for (std::size_t i = 1; i < mesh.positions.size(); ++i) EXPECT_GT(mesh.positions[i].x - mesh.positions[i - 1].x, 1.0);
}

TEST(Weld, RefusesATooSmallTolerance) {
  Mesh mesh;
  mesh.positions = {{1e10, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_TRUE(test::contains(errorMessage([&] { weld(mesh, 1e-9); }), "too small"));
}

TEST(Weld, KeepsThinWalls) {
  // Two plates of two triangles, a nanometre apart, with different neighbours: joined edges would have four triangles.
  Mesh mesh;
  for (const double z : {0.0, 1e-9}) {
    mesh.positions.emplace_back(0, 0, z);
    mesh.positions.emplace_back(1, 0, z);
    mesh.positions.emplace_back(0.5, 1, z > 0 ? 1.0 : -1.0);
    mesh.positions.emplace_back(0.5, -1, z > 0 ? 1.0 : -1.0);
  }
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}, {5, 4, 7}};
  const Mesh before = mesh;
  const Weld result = weld(mesh, 1e-6);
  EXPECT_EQ(result.joined.count, 0u);
  EXPECT_EQ(result.refused.count, 2u);
  EXPECT_EQ(result.refused.first[0].vertices, (std::vector<std::uint32_t>{4, 0}));
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.positions, before.positions);
}

TEST(Weld, RefusesAtNonManifoldEdgesOnly) {
  // The same wall, and a seam of two other vertices that is closed.
  Mesh mesh;
  mesh.positions = {{0, 0, 0},     {1, 0, 0}, {0.5, 1, 1}, {0.5, -1, 1}, {0, 0, 1e-9}, {1, 0, 1e-9}, {0.5, 1, -1},
                    {0.5, -1, -1}, {9, 0, 0}, {9, 1, 0},   {8, 0, 0},    {9, 0, 1e-9}, {9, 1, 1e-9}, {10, 0, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {4, 5, 6}, {5, 4, 7}, {8, 9, 10}, {12, 11, 13}};
  const Weld result = weld(mesh, 1e-6);
  EXPECT_EQ(result.refused.count, 2u);
  EXPECT_EQ(result.joined.count, 2u);
  EXPECT_EQ(mesh.positions.size(), 12u);
}

TEST(Weld, JoinsCopiesOfASurface) {
  // Another cube at the same position up to a nanometre: edges get four triangles, two of them duplicates.
  Mesh mesh = test::joined(test::cube(), test::cube(1, glm::dvec3(1e-9)));
  const Weld result = weld(mesh, 1e-6);
  EXPECT_EQ(result.joined.count, 8u);
  EXPECT_EQ(result.refused.count, 0u);
  EXPECT_EQ(mesh.positions, test::cube().positions);
}

TEST(Weld, JoinsAtEdgesThatWereNonManifoldBefore) {
  // Three pages meet at an edge; the tolerance closes a seam in one of them.
  Mesh mesh;
  mesh.positions = {{0, 0, 0},   {1, 0, 0},      {0.5, 1, 0}, {0.5, -1, 0},
                    {0.5, 0, 1}, {0.5, 1, 1e-9}, {2, 2, 0},   {1, 1e-9, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {5, 7, 6}};
  const Weld result = weld(mesh, 1e-6);
  EXPECT_EQ(result.joined.count, 2u);
  EXPECT_EQ(result.refused.count, 0u);
}

TEST(Weld, IgnoresUnusedVertices) {
  Mesh mesh = test::joined({}, test::cube());
  mesh.positions.insert(mesh.positions.begin(), glm::dvec3(1e-9, 0, 0));
  for (glm::uvec3& t : mesh.triangles) t += 1u;
  EXPECT_EQ(weld(mesh, 1e-6).joined.count, 0u);
  EXPECT_EQ(mesh.positions[1], glm::dvec3(0));
  EXPECT_EQ(mesh.positions.size(), 9u);
}

TEST(Weld, KeepsACleanMesh) {
  Mesh mesh = test::sphere(5, 8);
  const Mesh before = mesh;
  EXPECT_EQ(weld(mesh, 0).joined.count, 0u);
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(mesh.triangles, before.triangles);
}

}  // namespace
}  // namespace malus::prep
