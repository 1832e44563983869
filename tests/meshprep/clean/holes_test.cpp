#include "meshprep/clean/holes.h"

#include <gtest/gtest.h>

#include "meshprep/clean/degenerate_faces.h"
#include "meshprep/clean/edges.h"
#include "meshprep/clean/orient.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

// Cube without its two faces at y = 1 and one triangle at z = 0.
Mesh openCube() {
  Mesh mesh = test::cube();
  mesh.triangles.erase(mesh.triangles.begin() + 6, mesh.triangles.begin() + 8);
  return mesh;
}

TEST(Holes, FindsNoneInAClosedMesh) { EXPECT_TRUE(findHoles(edgeUses(test::sphere(5, 8).triangles)).empty()); }

TEST(Holes, ReportsVerticesAndLength) {
  const Mesh mesh = openCube();
  const std::vector<Loop> loops = findHoles(edgeUses(mesh.triangles));
  ASSERT_EQ(loops.size(), 1u);
  EXPECT_EQ(loops[0].size(), 4u);
  EXPECT_EQ(loops[0].front(), 2u);
  const Findings holes = describeHoles(mesh, loops);
  EXPECT_EQ(holes.first[0].at, glm::dvec3(0.5, 1, 0.5));
  EXPECT_CONTAINS(holes.first[0].what, "4 edges", "4 m");
}

TEST(Holes, FillsHolesUpToTheLimit) {
  Mesh mesh = openCube();
  EXPECT_EQ(fillHoles(mesh, findHoles(edgeUses(mesh.triangles)), 3).left.count, 1u);
  EXPECT_EQ(mesh.triangles.size(), 10u);
  const FilledHoles result = fillHoles(mesh, findHoles(edgeUses(mesh.triangles)), 4);
  EXPECT_EQ(result.filled.count, 1u);
  EXPECT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(findHoles(edgeUses(mesh.triangles)).empty());
  const OrientResult sides = orient(mesh, false);
  EXPECT_EQ(sides.flipped.count, 0u);  // the lid has the side of the rest
  EXPECT_NEAR(sides.components[0].signedVolume, 1, 1e-12);
}

TEST(Holes, FillsWithoutTrianglesOfZeroArea) {
  // Cube without its side at y = 0, with more vertices on edge 0-1 of the rim.
  Mesh mesh = test::cube();
  mesh.triangles.erase(mesh.triangles.begin() + 4, mesh.triangles.begin() + 6);
  mesh.positions.emplace_back(0.25, 0, 0);  // 8
  mesh.positions.emplace_back(0.5, 0, 0);   // 9
  mesh.triangles[1] = {0, 3, 8};            // was {0, 3, 1}
  mesh.triangles.emplace_back(8, 3, 9);
  mesh.triangles.emplace_back(9, 3, 1);
  const FilledHoles filled = fillHoles(mesh, findHoles(edgeUses(mesh.triangles)), 100);
  EXPECT_EQ(filled.filled.count, 1u);
  EXPECT_TRUE(findHoles(edgeUses(mesh.triangles)).empty());
  for (const glm::uvec3& t : mesh.triangles)
    EXPECT_FALSE(isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]));

  // A slit along a line has no area.
  Mesh slit = test::cube();
  slit.positions.emplace_back(0.5, 0, 0);
  slit.triangles[1] = {0, 3, 8};
  slit.triangles.emplace_back(8, 3, 1);
  const FilledHoles left = fillHoles(slit, findHoles(edgeUses(slit.triangles)), 100);
  EXPECT_EQ(left.filled.count, 0u);
  EXPECT_EQ(left.left.count, 1u);
}

TEST(Holes, LeavesHolesWhoseCapsWouldCrossTheSurface) {
  // A spike of the floor reaches through the open lid of a box.
  const auto boxWithSpike = [](double height) {
    Mesh mesh = openCube();
    mesh.positions.emplace_back(0.4, height, 0.4);  // 8
    mesh.positions.emplace_back(0.6, 0.25, 0.4);
    mesh.positions.emplace_back(0.5, 0.25, 0.6);
    mesh.positions.emplace_back(0.5, 0.2, 0.5);
    for (const glm::uvec3 t :
         {glm::uvec3(8, 9, 10), glm::uvec3(8, 11, 9), glm::uvec3(8, 10, 11), glm::uvec3(9, 11, 10)})
      mesh.triangles.push_back(t);
    return mesh;
  };
  Mesh crossed = boxWithSpike(1.5), free = boxWithSpike(0.9);
  const std::size_t before = crossed.triangles.size();
  const FilledHoles left = fillHoles(crossed, findHoles(edgeUses(crossed.triangles)), 4);
  EXPECT_EQ(left.filled.count, 0u);
  EXPECT_EQ(left.left.count, 1u);
  EXPECT_CONTAINS(left.left.first.at(0).what, "cross");
  EXPECT_EQ(crossed.triangles.size(), before);
  EXPECT_EQ(fillHoles(free, findHoles(edgeUses(free.triangles)), 4).filled.count, 1u);
  EXPECT_EQ(free.triangles.size(), before + 2);
}

TEST(Holes, FindsTwoLoops) {
  Mesh mesh = test::sphere(9, 16);
  mesh.triangles.erase(mesh.triangles.begin() + 100);
  mesh.triangles.erase(mesh.triangles.begin() + 19, mesh.triangles.begin() + 21);
  const std::vector<Loop> loops = findHoles(edgeUses(mesh.triangles));
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size() + loops[1].size(), 7u);
}

TEST(Holes, LeavesLoopsThatCrossThemselves) {
  // A strip around a bow tie, whose projected loop crosses itself.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {2, 2, 0}, {2, 0, 0}, {0, 2, 0}, {0, 0, 1}, {2, 2, 1}, {2, 0, 1}, {0, 2, 1}};
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    mesh.triangles.emplace_back(i, j, j + 4);
    mesh.triangles.emplace_back(i, j + 4, i + 4);
  }
  const FilledHoles result = fillHoles(mesh, findHoles(edgeUses(mesh.triangles)), 100);
  EXPECT_EQ(result.left.count, 2u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
}

TEST(Holes, LeavesHolesWhoseCapWouldBeNonManifold) {
  // Tetrahedron without two faces, whose last edge is used twice by another surface.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 1}, {0.5, 0.5, -1}, {0.5, 0.5, -2}};
  mesh.triangles = {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {0, 2, 5}, {2, 0, 6}, {1, 3, 5}, {3, 1, 6}};
  std::vector<Loop> square = {{0, 3, 2, 1}};
  const FilledHoles result = fillHoles(mesh, square, 4);
  EXPECT_EQ(result.left.count, 1u);
  EXPECT_EQ(mesh.triangles.size(), 8u);
}

}  // namespace
}  // namespace malus::prep
