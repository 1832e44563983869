#include "meshprep/clean/degenerate_faces.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

TEST(DegenerateFaces, CountsBothKindsAndKeepsTheRestInOrder) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0}};
  mesh.triangles = {{0, 1, 3}, {0, 0, 3}, {0, 1, 2}, {1, 2, 3}, {3, 1, 3}, {0, 4, 3}};
  const DegenerateCounts counts = dropDegenerateFaces(mesh);
  EXPECT_EQ(counts.repeatedCorner, 2u);
  EXPECT_EQ(counts.zeroArea, 2u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 3}, {1, 2, 3}}));
  EXPECT_EQ(mesh.positions.size(), 5u);
}

TEST(DegenerateFaces, SliversAndTinyOrHugeTrianglesStay) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0.5, 1e-9, 0}, {1e-200, 0, 0}, {0, 1e-200, 0}, {1e30, 0, 0}, {0, 1e30, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 3, 4}, {0, 5, 6}};
  dropDegenerateFaces(mesh);
  EXPECT_EQ(mesh.triangles.size(), 3u);
}

TEST(DegenerateFaces, CollinearUpToRounding) {
  Mesh mesh;
  mesh.positions = {{0.1, 0.2, 0.3}, {0.1 + 1.0 / 3, 0.2 + 2.0 / 3, 0.3 + 1}, {0.1 + 2.0 / 3, 0.2 + 4.0 / 3, 2.3}};
  mesh.triangles = {{0, 1, 2}};
  EXPECT_EQ(dropDegenerateFaces(mesh).zeroArea, 1u);
}

}  // namespace
}  // namespace malus::prep
