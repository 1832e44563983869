#include "meshprep/clean/fans.h"

#include <algorithm>
#include <map>
#include <random>

#include <gtest/gtest.h>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/orient.h"
#include "meshprep/clean/weld.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

using test::cube;
using test::joined;

std::size_t crowdedEdges(const Mesh& mesh) {
  std::size_t count = 0;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) { count += edge.size() > 2 ? 1u : 0u; });
  return count;
}

std::size_t openEdges(const Mesh& mesh) {
  std::size_t count = 0;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) { count += edge.size() == 1 ? 1u : 0u; });
  return count;
}

// Returns the positions of all corners.
std::vector<std::array<glm::dvec3, 3>> soup(const Mesh& mesh) {
  std::vector<std::array<glm::dvec3, 3>> result;
  for (const glm::uvec3& t : mesh.triangles)
    result.push_back({mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z]});
  return result;
}

TEST(Fans, KeepsACubeAndASphere) {
  for (const Mesh& before : {cube(), test::sphere(7, 12)}) {
    Mesh mesh = before;
    const Fans fans = splitFans(mesh, edgeUses(mesh.triangles));
    EXPECT_FALSE(fans.changed());
    EXPECT_EQ(mesh.positions, before.positions);
    EXPECT_EQ(mesh.triangles, before.triangles);
  }
}

TEST(Fans, SeparatesCubesAtASharedEdge) {
  Mesh mesh = joined(cube(), cube(1, {1, 1, 0}));
  const Mesh before = mesh;
  EXPECT_EQ(weld(mesh, 0).joined.count, 2u);
  EXPECT_EQ(crowdedEdges(mesh), 1u);
  const Fans fans = splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(fans.edges.count, 1u);
  EXPECT_EQ(fans.vertices.count, 2u);
  EXPECT_EQ(crowdedEdges(mesh), 0u);
  EXPECT_EQ(openEdges(mesh), 0u);
  EXPECT_EQ(soup(mesh), soup(before));
  const OrientResult sides = orient(mesh, false);
  ASSERT_EQ(sides.components.size(), 2u);
  EXPECT_NEAR(sides.components[0].signedVolume, 1, 1e-12);
  EXPECT_NEAR(sides.components[1].signedVolume, 1, 1e-12);
}

TEST(Fans, RestoresTheOrderOfWeldedVertices) {
  Mesh mesh = joined(cube(), cube(1, {1, 1, 0}));
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.sourceVertices.push_back(i);
  mesh.sourceCorners = mesh.triangles;
  const Mesh before = mesh;
  weld(mesh, 0);
  splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(mesh.triangles, before.triangles);
  EXPECT_EQ(mesh.sourceVertices, before.sourceVertices);
}

TEST(Fans, KeepsBothWallsOfASharedFace) {
  Mesh mesh = joined(cube(), cube(1, {1, 0, 0}));
  weld(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 12u);
  EXPECT_EQ(crowdedEdges(mesh), 5u);  // four sides and the diagonal of the wall
  splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(crowdedEdges(mesh), 0u);
  EXPECT_EQ(openEdges(mesh), 0u);
  EXPECT_EQ(orient(mesh, false).components.size(), 2u);
}

TEST(Fans, SeparatesAFinFromACube) {
  for (const glm::dvec3& tip : {glm::dvec3(2, 2, 0.5), glm::dvec3(0.5, 0.5, 0.5)}) {  // outside and inside
    Mesh mesh = cube();
    mesh.positions.push_back(tip);
    mesh.triangles.emplace_back(3, 7, 8);
    const Fans fans = splitFans(mesh, edgeUses(mesh.triangles));
    EXPECT_EQ(fans.edges.count, 1u);
    EXPECT_EQ(crowdedEdges(mesh), 0u);
    EXPECT_EQ(openEdges(mesh), 3u);
    const OrientResult sides = orient(mesh, false);
    ASSERT_EQ(sides.components.size(), 2u);
    EXPECT_TRUE(sides.components[0].closed);
    EXPECT_EQ(sides.components[0].triangles, 12u);
  }
}

TEST(Fans, SeparatesTheSidesOfADoubleSidedQuad) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {2, 1, 0}, {3, 2, 0}};
  splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(crowdedEdges(mesh), 0u);
  // The two triangles of each side share the diagonal.
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::uint32_t>> edges;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) {
    for (const EdgeUse& use : edge) edges[{edge[0].low, edge[0].high}].push_back(use.triangle);
  });
  const auto together = [&](std::uint32_t a, std::uint32_t b) {
    return std::any_of(edges.begin(), edges.end(), [&](const auto& edge) {
      return edge.second == std::vector<std::uint32_t>{a, b};
    });
  };
  EXPECT_TRUE(together(0, 1));
  EXPECT_TRUE(together(2, 3));
}

TEST(Fans, SeparatesConesAtTheirCommonApex) {
  Mesh mesh = joined(cube(), cube(1, {1, 1, 1}));
  weld(mesh, 0);
  EXPECT_EQ(mesh.positions.size(), 15u);
  const Fans fans = splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(fans.edges.count, 0u);
  EXPECT_EQ(fans.vertices.count, 1u);
  EXPECT_EQ(fans.vertices.first[0].at, glm::dvec3(1));
  EXPECT_EQ(mesh.positions.size(), 16u);
}

// Solid of unit cells: the faces between filled and empty cells.
Mesh cells(const std::vector<glm::ivec3>& filled) {
  Mesh mesh;
  const auto isFilled = [&](const glm::ivec3& c) { return std::find(filled.begin(), filled.end(), c) != filled.end(); };
  for (const glm::ivec3& c : filled)
    for (int axis = 0; axis < 3; ++axis)
      for (const int side : {0, 1}) {
        glm::ivec3 neighbour = c;
        neighbour[axis] += side == 1 ? 1 : -1;
        if (isFilled(neighbour)) continue;
        glm::dvec3 corner(c);
        corner[axis] += side;
        glm::dvec3 u(0), v(0);
        u[(axis + 1) % 3] = 1;
        v[(axis + 2) % 3] = 1;
        if (side == 0) std::swap(u, v);
        const auto first = static_cast<std::uint32_t>(mesh.positions.size());
        for (const glm::dvec3& p : {corner, corner + u, corner + u + v, corner + v}) mesh.positions.push_back(p);
        mesh.triangles.emplace_back(first, first + 1, first + 2);
        mesh.triangles.emplace_back(first, first + 2, first + 3);
      }
  weld(mesh, 0);
  return mesh;
}

TEST(Fans, CutsEdgesAtWhichASolidTouchesItself) {
  // A ring of cells that touches its first cell along an edge, and is connected to it around both ends: splitting
  // vertices cannot separate the edge.
  std::vector<glm::ivec3> ring;
  for (int z = 0; z < 3; ++z)
    for (int x = 0; x < 2; ++x)
      for (int y = 0; y < 2; ++y)
        if (z != 1 || x == y) ring.emplace_back(x, y, z);
  Mesh mesh = cells(ring);
  ASSERT_EQ(crowdedEdges(mesh), 1u);
  const Mesh before = mesh;
  const Fans fans = splitFans(mesh, edgeUses(mesh.triangles));
  EXPECT_EQ(fans.edges.count, 1u);
  EXPECT_EQ(fans.cutEdges, 1u);
  EXPECT_EQ(crowdedEdges(mesh), 0u);
  EXPECT_EQ(openEdges(mesh), 0u);
  EXPECT_EQ(mesh.triangles.size(), before.triangles.size() + 4);
  const OrientResult sides = orient(mesh, false);
  ASSERT_EQ(sides.components.size(), 1u);
  EXPECT_NEAR(sides.components[0].signedVolume, 10, 1e-12);
}

TEST(Fans, RefusesRandomFaces) {
  Mesh mesh;
  std::mt19937 random(7);
  for (int i = 0; i < 3000; ++i) mesh.positions.emplace_back(random() % 97, random() % 89, random() % 83);
  while (mesh.triangles.size() < 60'000) {
    const glm::uvec3 t(random() % 3000, random() % 3000, random() % 3000);
    if (t.x != t.y && t.y != t.z && t.z != t.x) mesh.triangles.push_back(t);
  }
  EXPECT_TRUE(test::contains(test::errorMessage([&] { splitFans(mesh, edgeUses(mesh.triangles), "a.ply"); }), "a.ply",
                             "surface"));
}

}  // namespace
}  // namespace malus::prep
