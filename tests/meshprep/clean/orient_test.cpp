#include "meshprep/clean/orient.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/shell_nesting.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::cube;
using test::flipped;
using test::joined;

double signedVolume(const Mesh& mesh, std::size_t first, std::size_t count) {
  double volume = 0;
  for (std::size_t i = first; i < first + count; ++i) {
    const glm::uvec3 t = mesh.triangles[i];
    volume += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
  }
  return volume;
}

TEST(Orient, KeepsAnOutwardCube) {
  Mesh mesh = cube();
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(mesh.triangles, cube().triangles);
  EXPECT_EQ(result.flipped.count, 0u);
  ASSERT_EQ(result.components.size(), 1u);
  EXPECT_TRUE(result.components[0].closed);
  EXPECT_TRUE(result.components[0].orientable);
  EXPECT_EQ(result.components[0].triangles, 12u);
  EXPECT_NEAR(result.components[0].signedVolume, 1, 1e-12);
  EXPECT_EQ(result.boundaryEdges + result.nonManifoldEdges, 0u);
}

TEST(Orient, FlipsAnInwardCubeFarFromTheOrigin) {
  Mesh mesh = flipped(cube(1e-3, {1e4, -1e4, 1e4}));
  EXPECT_EQ(orient(mesh, false).flipped.count, 12u);
  EXPECT_EQ(mesh.triangles, cube().triangles);
}

TEST(Orient, FlipsTheMinority) {
  Mesh mesh = cube();
  for (const std::size_t i : {0u, 5u, 9u})
    mesh.triangles[i] = {mesh.triangles[i].x, mesh.triangles[i].z, mesh.triangles[i].y};
  EXPECT_EQ(orient(mesh, false).flipped.count, 3u);
  EXPECT_EQ(mesh.triangles, cube().triangles);
}

// A building of four walls and a roof, without a floor. The roof has many triangles, which face inward.
Mesh building(std::uint32_t roofColumns) {
  Mesh mesh = cube();
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    const auto isAt = [&](double z) {
      return mesh.positions[t.x].z == z && mesh.positions[t.y].z == z && mesh.positions[t.z].z == z;
    };
    return isAt(0) || isAt(1);
  });
  const glm::dvec3 a = mesh.positions[4], b = mesh.positions[6];
  const std::uint32_t left = 4, right = 5, leftEnd = 6, rightEnd = 7;
  std::vector<std::uint32_t> ridge;  // from a to b
  for (std::uint32_t i = 0; i <= roofColumns; ++i) {
    ridge.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.push_back(a + (b - a) * (static_cast<double>(i) / roofColumns) + glm::dvec3(0.5, 0, 0.1));
  }
  for (std::uint32_t i = 0; i < roofColumns; ++i) {
    mesh.triangles.emplace_back(left, ridge[i + 1], ridge[i]);
    mesh.triangles.emplace_back(right, ridge[i], ridge[i + 1]);
  }
  mesh.triangles.emplace_back(left, leftEnd, ridge.back());
  mesh.triangles.emplace_back(right, ridge.back(), rightEnd);
  return mesh;
}

TEST(Orient, ShowsTheVisibleSideOfABuildingOutward) {
  for (const bool inward : {false, true}) {
    Mesh mesh = inward ? flipped(building(20)) : building(20);
    const Mesh before = mesh;
    const OrientResult result = orient(mesh, false);
    ASSERT_EQ(result.components.size(), 1u);
    EXPECT_EQ(result.orientedByVisibility, 1u);
    for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
      const glm::uvec3 t = mesh.triangles[i];
      const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
      EXPECT_GT(glm::dot(glm::cross(b - a, c - a), (a + b + c) / 3.0 - glm::dvec3(0.5, 0.5, 0.3)), 0) << i;
    }
  }
}

TEST(Orient, KeepsConsistentOpenComponents) {
  Mesh mesh = flipped(cube());
  mesh.triangles.resize(10);
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.flipped.count, 0u);
  EXPECT_EQ(result.orientedByVisibility + result.orientedByMajority, 0u);
}

TEST(Orient, FollowsTheMajorityOfOpenComponents) {
  // Both sides of a flat surface are visible.
  Mesh mesh = cube();
  mesh.triangles = {{0, 1, 3}, {0, 2, 3}};
  mesh.positions.emplace_back(2, 0, 0);
  mesh.triangles.emplace_back(1, 8, 3);
  const OrientResult flat = orient(mesh, false);
  EXPECT_EQ(flat.flipped.count, 1u);
  EXPECT_EQ(flat.orientedByMajority, 1u);
  EXPECT_EQ(mesh.triangles[0], glm::uvec3(0, 1, 3));
}

TEST(Orient, FollowsTheMajorityOfOpenSurfaces) {
  Mesh mesh = cube();
  mesh.triangles.resize(10);  // one side off
  for (std::size_t i = 0; i < 7; ++i)
    mesh.triangles[i] = {mesh.triangles[i].x, mesh.triangles[i].z, mesh.triangles[i].y};
  Mesh expected = cube();
  expected.triangles.resize(10);
  expected = flipped(expected);
  const OrientResult result = orient(mesh, true);
  EXPECT_EQ(result.flipped.count, 3u);
  EXPECT_EQ(mesh.triangles, expected.triangles);
  EXPECT_FALSE(result.components[0].closed);
  EXPECT_EQ(result.boundaryEdges, 4u);
}

TEST(Orient, KeepsTheFirstTriangleOfATie) {
  Mesh mesh = cube();
  mesh.triangles = {{0, 2, 3}, {0, 1, 3}};
  orient(mesh, false);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 2, 3}, {0, 3, 1}}));
}

TEST(Orient, NeverFlipsAnOpenSurfaceAsAWhole) {
  Mesh mesh = flipped(cube());
  mesh.triangles[3] = cube().triangles[3];
  EXPECT_EQ(orient(mesh, true).flipped.count, 1u);
  EXPECT_EQ(mesh.triangles, flipped(cube()).triangles);
}

TEST(Orient, KeepsCavities) {
  Mesh mesh = joined(cube(4), flipped(cube(1, {1, 1, 1})));
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.flipped.count, 0u);
  EXPECT_EQ(result.nested, 1u);
  EXPECT_LT(result.components[1].signedVolume, 0);
}

TEST(Orient, FlipsCavitiesWithTheirSolid) {
  Mesh mesh = joined(flipped(cube(4)), cube(1, {1, 1, 1}));
  EXPECT_EQ(orient(mesh, false).flipped.count, 24u);
  EXPECT_NEAR(signedVolume(mesh, 0, 12), 64, 1e-9);
  EXPECT_NEAR(signedVolume(mesh, 12, 12), -1, 1e-9);
}

TEST(Orient, OrientsASolidInACavityOutward) {
  Mesh mesh = joined(joined(cube(9), flipped(cube(5, {2, 2, 2}))), flipped(cube(1, {4, 4, 4})));
  EXPECT_EQ(orient(mesh, false).flipped.count, 12u);
  EXPECT_GT(signedVolume(mesh, 24, 12), 0);
}

TEST(Orient, DoesNotNestIntersectingSolids) {
  Mesh mesh = joined(cube(4), flipped(cube(2, {3, 1, 1})));
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.flipped.count, 12u);
  EXPECT_EQ(result.nested, 0u);
}

TEST(Orient, KeepsAMoebiusStrip) {
  Mesh mesh;
  constexpr std::uint32_t kSteps = 9;
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const double a = 2 * 3.14159265358979 * i / kSteps;
    const glm::dvec3 out(std::cos(a), std::sin(a), 0),
        side = std::cos(a / 2) * out + std::sin(a / 2) * glm::dvec3(0, 0, 1);
    mesh.positions.push_back(3.0 * out + side);
    mesh.positions.push_back(3.0 * out - side);
  }
  for (std::uint32_t i = 0; i < kSteps; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1;
    const bool wraps = i + 1 == kSteps;
    const std::uint32_t c = wraps ? 1 : a + 2, d = wraps ? 0 : b + 2;
    mesh.triangles.emplace_back(a, b, c);
    mesh.triangles.emplace_back(b, d, c);
  }
  const std::vector<glm::uvec3> before = mesh.triangles;
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.notOrientable, 1u);
  EXPECT_FALSE(result.components[0].orientable);
  EXPECT_EQ(mesh.triangles, before);
}

TEST(Orient, ClosesCubesThatShareAnEdge) {
  // Two cubes that touch along an edge, which has four triangles.
  Mesh mesh = joined(cube(), flipped(cube(1, {1, 1, 0})));
  // Vertices 3 and 7 of the first are 8 and 12 of the second.
  for (glm::uvec3& t : mesh.triangles)
    for (int i = 0; i < 3; ++i) t[i] = t[i] == 8 ? 3 : t[i] == 12 ? 7 : t[i];
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.nonManifoldEdges, 1u);
  ASSERT_EQ(result.components.size(), 2u);
  for (const Component& component : result.components) {
    EXPECT_TRUE(component.closed);
    EXPECT_NEAR(component.signedVolume, 1, 1e-12);
  }
  EXPECT_EQ(result.flipped.count, 12u);
}

TEST(Orient, MakesAFinASeparateComponent) {
  Mesh mesh = cube();
  mesh.positions.emplace_back(2, 2, 0.5);
  mesh.triangles.emplace_back(3, 7, 8);
  const OrientResult result = orient(mesh, false);
  EXPECT_EQ(result.nonManifoldEdges, 1u);
  ASSERT_EQ(result.components.size(), 2u);
  EXPECT_TRUE(result.components[0].closed);
  EXPECT_FALSE(result.components[1].closed);
}

TEST(Orient, CountsClosedComponentsWithoutVolume) {
  Mesh mesh = cube();
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  EXPECT_EQ(orient(mesh, false).withoutVolume, 1u);
}

TEST(EdgeUses, ListsAllTrianglesOfAnEdge) {
  const std::vector<glm::uvec3> triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  std::size_t edges = 0, most = 0;
  forEachEdge(edgeUses(triangles), [&](std::span<const EdgeUse> edge) {
    ++edges;
    most = std::max(most, edge.size());
    if (edge.size() == 3) {
      EXPECT_TRUE(edge[0].forward);
      EXPECT_FALSE(edge[1].forward);
      EXPECT_TRUE(edge[2].forward);
    }
  });
  EXPECT_EQ(edges, 7u);
  EXPECT_EQ(most, 3u);
}

TEST(ShellNesting, WindingNumberIsOneInsideAndZeroOutside) {
  const Mesh mesh = test::sphere(7, 12);
  const Shell shell{mesh.triangles, 4};
  EXPECT_NEAR(windingNumber(shell, mesh.positions, {0.1, 0.2, -0.3}), 1, 1e-9);
  EXPECT_NEAR(windingNumber(shell, mesh.positions, {1.1, 0, 0}), 0, 1e-9);
}

}  // namespace
}  // namespace malus::prep
