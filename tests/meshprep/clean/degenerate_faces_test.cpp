#include "meshprep/clean/degenerate_faces.h"

#include <gtest/gtest.h>

#include "meshprep/clean/edges.h"
#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

TEST(DegenerateFaces, CountsBothKindsAndKeepsTheOrder) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 0, 3}, {0, 1, 2}, {1, 2, 3}, {3, 1, 3}, {0, 4, 3}};
  mesh.sourceFaces = {10, 11, 12, 13, 14, 15};
  const DegenerateFaces counts = dropDegenerateFaces(mesh);
  EXPECT_EQ(counts.zeroArea.first[0].faces, std::vector<std::uint32_t>{15});  // needles go first
  EXPECT_EQ(counts.zeroArea.first[1].faces, std::vector<std::uint32_t>{12});
  EXPECT_EQ(mesh.sourceFaces, (std::vector<std::uint32_t>{10, 13}));
  EXPECT_EQ(counts.repeatedCorner.count, 2u);
  EXPECT_EQ(counts.zeroArea.count, 2u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(DegenerateFaces, KeepsSliversAndTinyOrHugeTriangles) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}, {1e30, 0, 0}, {0, 1e30, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  dropDegenerateFaces(mesh);
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(DegenerateFaces, DropsCollinearCornersWithinRounding) {
  Mesh mesh;
  mesh.positions = {{0.1, 0.2, 0.3}, {0.1 + 1.0 / 3, 0.2 + 2.0 / 3, 0.3 + 1}, {0.1 + 2.0 / 3, 0.2 + 4.0 / 3, 2.3}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(dropDegenerateFaces(mesh).zeroArea.count, 1u);
}

// Cube with two more vertices on edge 0-1; on one side only faces without area connect them.
Mesh cubeWithFlatFaces() {
  Mesh mesh = test::cube();
  mesh.positions.emplace_back(0.25, 0, 0);  // 8
  mesh.positions.emplace_back(0.5, 0, 0);   // 9
  // {0, 1, 5} becomes a fan from 5 over both; the face below, {0, 3, 1}, keeps the whole edge.
  mesh.triangles[4] = {0, 8, 5};
  mesh.triangles.emplace_back(8, 9, 5);
  mesh.triangles.emplace_back(9, 1, 5);
  mesh.triangles.emplace_back(0, 1, 9);
  mesh.triangles.emplace_back(0, 9, 8);
  return mesh;
}

double signedVolume(const Mesh& mesh) {
  double volume = 0;
  for (const glm::uvec3& t : mesh.triangles)
    volume += glm::dot(mesh.positions[t.x], glm::cross(mesh.positions[t.y], mesh.positions[t.z])) / 6;
  return volume;
}

void expectClosed(const Mesh& mesh) {
  forEachEdge(edgeUses(mesh.triangles), [](std::span<const EdgeUse> edge) {
    ASSERT_EQ(edge.size(), 2u);
    EXPECT_NE(edge[0].forward, edge[1].forward);
  });
}

TEST(DegenerateFaces, KeepsSurfacesClosed) {
  Mesh mesh = cubeWithFlatFaces();
  ASSERT_EQ(mesh.triangles.size(), 16u);
  const DegenerateFaces result = dropDegenerateFaces(mesh);
  EXPECT_EQ(result.zeroArea.count, 2u);
  EXPECT_EQ(result.neighboursCut.count, 2u);
  EXPECT_EQ(mesh.triangles.size(), 16u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    EXPECT_GT(
        glm::length(glm::cross(mesh.positions[t.y] - mesh.positions[t.x], mesh.positions[t.z] - mesh.positions[t.x])),
        0.1)
        << i;
  }
  expectClosed(mesh);
  EXPECT_NEAR(signedVolume(mesh), 1, 1e-12);
  EXPECT_EQ(dropDegenerateFaces(mesh).zeroArea.count, 0u);
}

// Cube with `count` more vertices on edge 0-1, closed by a fan of triangles without area from vertex 0.
Mesh cubeWithFanOfFlats(std::uint32_t count) {
  Mesh mesh = test::cube();
  std::vector<std::uint32_t> line = {0};
  for (std::uint32_t i = 0; i < count; ++i) {
    line.push_back(static_cast<std::uint32_t>(mesh.positions.size()));
    mesh.positions.emplace_back((i + 1.0) / (count + 1), 0, 0);
  }
  line.push_back(1);
  mesh.triangles[4] = {line[0], line[1], 5};
  for (std::size_t i = 1; i + 1 < line.size(); ++i) {
    mesh.triangles.emplace_back(line[i], line[i + 1], 5);
    mesh.triangles.emplace_back(0, line[i + 1], line[i]);
  }
  return mesh;
}

TEST(DegenerateFaces, ProcessesChainsFromTheirEnds) {
  for (const std::uint32_t count : {1u, 2u, 16u, 300u}) {
    Mesh mesh = cubeWithFanOfFlats(count);
    expectClosed(mesh);
    const DegenerateFaces result = dropDegenerateFaces(mesh);
    EXPECT_EQ(result.zeroArea.count, count);
    EXPECT_EQ(result.neighboursCut.count, count);
    EXPECT_EQ(mesh.triangles.size(), 12 + 2 * count);
    expectClosed(mesh);
    EXPECT_NEAR(signedVolume(mesh), 1, 1e-12);
    EXPECT_FALSE(dropDegenerateFaces(mesh).changed());
  }
}

TEST(DegenerateFaces, CollapsesShortEdges) {
  // Tetrahedron with a corner split in two within rounding: two needles.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1e-13, 0, 0}};
  mesh.triangles = {{0, 2, 1}, {0, 3, 2}, {4, 1, 3}, {1, 2, 3}, {0, 1, 4}, {0, 4, 3}};
  expectClosed(mesh);
  const DegenerateFaces result = dropDegenerateFaces(mesh);
  EXPECT_EQ(result.edgesCollapsed.count, 1u);
  EXPECT_EQ(result.edgesCollapsed.first[0].vertices, (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(result.zeroArea.count, 2u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  expectClosed(mesh);
  EXPECT_NEAR(signedVolume(mesh), 1.0 / 6, 1e-12);
}

TEST(DegenerateFaces, KeepsAttributesOfCorners) {
  Mesh mesh = cubeWithFlatFaces();
  for (std::uint32_t v = 0; v < mesh.positions.size(); ++v) mesh.sourceVertices.push_back(100 + v);
  for (const glm::uvec3& t : mesh.triangles) mesh.sourceCorners.push_back(t + 100u);
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k)
      mesh.cornerNormals.emplace_back(static_cast<float>(mesh.triangles[i][k] + 1), 0.0f, 0.0f);
  dropDegenerateFaces(mesh);
  std::size_t open = 0;
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      EXPECT_EQ(mesh.sourceCorners[i][k], mesh.triangles[i][k] + 100);
      const glm::vec3& normal = mesh.cornerNormals[3 * i + static_cast<std::size_t>(k)];
      if (normal == glm::vec3(0)) {
        ++open;
        EXPECT_GE(mesh.triangles[i][k], 8u);  // a corner that the cut made
      } else {
        EXPECT_EQ(normal.x, static_cast<float>(mesh.triangles[i][k] + 1));
      }
    }
  EXPECT_EQ(open, 4u);
}

}  // namespace
}  // namespace malus::prep
