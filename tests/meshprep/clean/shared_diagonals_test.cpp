#include "meshprep/clean/shared_diagonals.h"

#include <set>
#include <span>

#include <gtest/gtest.h>

#include "meshprep/clean/edges.h"
#include "meshprep/clean/triangulate.h"
#include "meshprep/prepare.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

const std::string kCubeVertices = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n";
const std::string kOpenCube = "f 4 3 2 1\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

// Adds the number of faces that were cut again.
void expectClosed(const std::string& text, std::size_t triangles, std::uint64_t& recut) {
  const test::TemporaryFile file(".obj", text);
  Report report;
  const Mesh mesh = prepare(file.path(), {}, report);
  EXPECT_EQ(mesh.triangles.size(), triangles) << text;
  EXPECT_EQ(report.count("edges-non-manifold") + report.count("edges-boundary"), 0u) << text;
  recut += report.count("polygons-recut");
}

TEST(SharedDiagonals, CutsQuadsWithAVertexOfValenceTwo) {
  // Vertex 9 belongs to two quads only, with either side of both first.
  std::uint64_t recut = 0;
  const std::string top = kCubeVertices + "v .5 .5 1.4\n" + kOpenCube;
  for (const char* faces :
       {"f 5 6 7 9\nf 5 9 7 8\n", "f 5 9 7 8\nf 5 6 7 9\n", "f 7 9 5 6\nf 8 5 9 7\n", "f 9 5 6 7\nf 9 7 8 5\n"})
    expectClosed(top + faces, 14, recut);
  EXPECT_EQ(recut, 2u);  // the others have different diagonals
}

TEST(SharedDiagonals, CutsPolygonsWithAChainOfSuchVertices) {
  std::uint64_t recut = 0;
  expectClosed(kCubeVertices + "v .3 .3 1.4\nv .7 .7 1.4\n" + kOpenCube + "f 5 6 7 10 9\nf 5 9 10 7 8\n", 16, recut);
  EXPECT_EQ(recut, 1u);
}

TEST(SharedDiagonals, KeepsOtherFacesUnchanged) {
  const test::TemporaryFile file(".obj", kCubeVertices + kOpenCube + "f 5 6 7 8\n");
  Report report;
  prepare(file.path(), {}, report);
  EXPECT_EQ(report.count("polygons-recut"), 0u);
}

TEST(SharedDiagonals, KeepsFacesBackToBack) {
  const test::TemporaryFile file(".obj", "v 0 0 0\nv 1 0 0\nv 1 1 .2\nv 0 1 0\nf 1 2 3 4\nf 1 4 3 2\n");
  Report report;
  EXPECT_EQ(prepare(file.path(), {}, report).triangles.size(), 4u);
  EXPECT_EQ(report.count("polygons-recut"), 0u);
  EXPECT_EQ(report.count("faces-opposite"), 2u);
  Options drop;
  drop.steps.dropOpposite = true;
  EXPECT_EQ(prepare(file.path(), drop, report).triangles.size(), 2u);
}

TEST(SharedDiagonals, AvoidsEdgesOfOtherFaces) {
  // The diagonal 1-3 of the quad is an edge of two triangles.
  Polygons polygons;
  polygons.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 1, 1}, {1, 0, 1}};
  for (const auto& face : std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 3}, {0, 2, 4}, {2, 0, 5}}) {
    polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
    polygons.closeFace();
  }
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygons, counts);
  EXPECT_EQ(counts.recut, 1u);
  std::size_t most = 0;
  forEachEdge(edgeUses(mesh.triangles), [&](std::span<const EdgeUse> edge) { most = std::max(most, edge.size()); });
  EXPECT_EQ(most, 2u);
}

TEST(SharedDiagonals, KeepsAttributesOfCorners) {
  Polygons polygons;
  polygons.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0.4}};
  for (const auto& face : std::vector<std::vector<std::uint32_t>>{{0, 1, 2, 4}, {0, 4, 2, 3}}) {
    for (const std::uint32_t v : face) polygons.cornerNormals.emplace_back(static_cast<float>(v), 0, 1);
    polygons.corners.insert(polygons.corners.end(), face.begin(), face.end());
    polygons.closeFace();
  }
  TriangulateCounts counts;
  const Mesh mesh = triangulate(polygons, counts);
  EXPECT_EQ(counts.recut, 1u);
  ASSERT_EQ(mesh.cornerNormals.size(), 12u);
  for (std::size_t c = 0; c < 12; ++c)
    EXPECT_EQ(mesh.cornerNormals[c].x, static_cast<float>(mesh.triangles[c / 3][static_cast<int>(c % 3)]));
}

}  // namespace
}  // namespace malus::prep
