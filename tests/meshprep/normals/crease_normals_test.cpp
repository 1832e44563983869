#include "meshprep/normals/crease_normals.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

TEST(CreaseNormals, CubeGetsThreeNormalsACorner) {
  Mesh mesh = test::cube();
  const NormalCounts counts = addCreaseNormals(mesh, 40);
  EXPECT_EQ(counts.added, 16u);
  EXPECT_EQ(counts.undefined, 0u);
  ASSERT_EQ(mesh.positions.size(), 24u);
  ASSERT_EQ(mesh.normals.size(), 24u);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  // Corners are where they were, in order; every normal is that of its face.
  for (std::size_t i = 0; i < 24; ++i) EXPECT_EQ(mesh.positions[i], test::cube().positions[i / 3]);
  for (std::size_t i = 0; i < 12; ++i) {
    const glm::uvec3 t = mesh.triangles[i], u = test::cube().triangles[i];
    const auto& p = test::cube().positions;
    const glm::vec3 face = glm::normalize(glm::cross(p[u.y] - p[u.x], p[u.z] - p[u.x]));
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(mesh.positions[t[c]], p[u[c]]);
      EXPECT_LT(glm::distance(mesh.normals[t[c]], face), 1e-6f);
    }
  }
}

TEST(CreaseNormals, CubeBeyond90DegreesIsSmoothAndWeightedByAngles) {
  // Two triangles of a face meet in some corners and one in others: the angles make every normal diagonal.
  Mesh mesh = test::cube();
  EXPECT_EQ(addCreaseNormals(mesh, 91).added, 0u);
  for (std::size_t i = 0; i < 8; ++i) {
    const glm::vec3 outward = glm::normalize(glm::vec3(mesh.positions[i]) - 0.5f);
    EXPECT_LT(glm::distance(mesh.normals[i], outward), 1e-6f);
  }
}

TEST(CreaseNormals, SphereIsNotSplit) {
  Mesh mesh = test::sphere(15, 32);
  const Mesh before = mesh;
  EXPECT_EQ(addCreaseNormals(mesh, 40).added, 0u);
  EXPECT_EQ(mesh.positions, before.positions);
  EXPECT_EQ(mesh.triangles, before.triangles);
  for (std::size_t i = 0; i < mesh.normals.size(); ++i) {
    EXPECT_NEAR(glm::length(mesh.normals[i]), 1, 1e-6);
    EXPECT_GT(glm::dot(mesh.normals[i], glm::vec3(mesh.positions[i])), 0.999f);
  }
}

TEST(CreaseNormals, AnEdgeOfExactlyTheCreaseAngleIsSmooth) {
  // A prism with nine sides: 40 degrees from one to the next.
  Mesh mesh;
  for (int i = 0; i < 9; ++i) {
    const double a = 2 * 3.14159265358979 * i / 9;
    mesh.positions.emplace_back(std::cos(a), std::sin(a), 0);
    mesh.positions.emplace_back(std::cos(a), std::sin(a), 1);
  }
  for (std::uint32_t i = 0; i < 9; ++i) {
    const std::uint32_t a = 2 * i, b = (a + 2) % 18;
    mesh.triangles.emplace_back(a, b, b + 1);
    mesh.triangles.emplace_back(a, b + 1, a + 1);
  }
  Mesh sharper = mesh;
  EXPECT_EQ(addCreaseNormals(mesh, 40).added, 0u);
  EXPECT_EQ(addCreaseNormals(sharper, 39.9).added, 18u);
}

TEST(CreaseNormals, FacesThatTouchInAVertexAloneAreApart) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}};
  EXPECT_EQ(addCreaseNormals(mesh, 180).added, 1u);
}

TEST(CreaseNormals, NonManifoldEdgeIsACrease) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}};
  EXPECT_EQ(addCreaseNormals(mesh, 180).added, 4u);
}

TEST(CreaseNormals, NormalsThatCancelAreCounted) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 1}};
  const NormalCounts counts = addCreaseNormals(mesh, 180);
  EXPECT_EQ(counts.undefined, 3u);
  for (const glm::vec3& n : mesh.normals) EXPECT_EQ(n, glm::vec3(0, 0, 1));
}

}  // namespace
}  // namespace malus::prep
