#include "meshprep/normals/authored_normals.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

// A unit square of two triangles that share the vertices 0 and 2, in the plane z = 0, looking up.
Mesh square(const std::vector<glm::vec3>& normals) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.cornerNormals = normals;
  return mesh;
}

const glm::vec3 kUp(0, 0, 1), kTilted(0.6f, 0, 0.8f), kNone(0);

TEST(AuthoredNormals, EqualOnesShareAVertexAndOthersDoNot) {
  Mesh mesh = square({kUp, kUp, kTilted, 2.0f * kUp, kUp, kUp});
  const AuthoredNormals result = addAuthoredNormals(mesh, 40);
  EXPECT_EQ(result.counts.added, 1u);
  EXPECT_EQ(result.missing, 0u);
  EXPECT_EQ(result.against.count, 0u);
  // Vertex 2 became two, by their first corners; the last corner's normal does not win.
  EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.normals, (std::vector<glm::vec3>{kUp, kUp, kTilted, kUp, kUp}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 3, 4}}));
}

TEST(AuthoredNormals, MissingOnesComeFromTheFaces) {
  Mesh mesh = square({kUp, kNone, kUp, kUp, kUp, glm::vec3(0)});
  const AuthoredNormals result = addAuthoredNormals(mesh, 40);
  EXPECT_EQ(result.missing, 2u);
  EXPECT_EQ(mesh.positions.size(), 4u);
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, kUp);
}

TEST(AuthoredNormals, OnesThatContradictTheirFaceAreTold) {
  Mesh mesh = square({kUp, kUp, kUp, kUp, -kUp, kUp});
  mesh.sourceFaces = {4, 9};
  const AuthoredNormals result = addAuthoredNormals(mesh, 40);
  ASSERT_EQ(result.against.count, 1u);
  EXPECT_EQ(result.against.first[0].faces, std::vector<std::uint32_t>{9});
  EXPECT_EQ(mesh.normals[mesh.triangles[1].y], -kUp);  // left
}

TEST(AuthoredNormals, TheyTurnWithTheirFaceOnlyWhereTheyMust) {
  // The first face was flipped, its normals with it; the second face was turned to where its normals point.
  Mesh mesh = square({-kUp, -kUp, -kTilted, kUp, kUp, kUp});
  mesh.flipped = {1, 1};
  const AuthoredNormals result = addAuthoredNormals(mesh, 40);
  EXPECT_EQ(result.against.count, 0u);
  EXPECT_EQ(mesh.normals[mesh.triangles[0].x], kUp);
  EXPECT_EQ(mesh.normals[mesh.triangles[0].z], kTilted);
  EXPECT_EQ(mesh.normals[mesh.triangles[1].y], kUp);
}

}  // namespace
}  // namespace malus::prep
