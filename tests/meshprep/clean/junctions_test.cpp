#include "meshprep/clean/junctions.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

// A large triangle beside two small ones whose common corner is in the middle of its edge.
Mesh junction(double off) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {3, 0, 0}, {1.5, 1, 0}, {1, off, 0}, {0, -1, 0}, {3, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {0, 4, 3}, {3, 5, 1}};
  return mesh;
}

TEST(Junctions, FindsAVertexInTheMiddleOfAnEdge) {
  const Junctions junctions = findJunctions(junction(0));
  ASSERT_EQ(junctions.found.count, 1u);
  EXPECT_EQ(junctions.found.first[0].vertices, (std::vector<std::uint32_t>{3, 0, 1}));
  EXPECT_EQ(junctions.found.first[0].faces, std::vector<std::uint32_t>{0});
  EXPECT_EQ(junctions.found.first[0].at, glm::dvec3(1, 0, 0));
  EXPECT_TRUE(junctions.complete);
}

TEST(Junctions, ToleratesRoundingOfDecimals) {
  EXPECT_EQ(findJunctions(junction(-1e-6)).found.count, 1u);
  EXPECT_EQ(findJunctions(junction(-1e-4)).found.count, 0u);
}

TEST(Junctions, IgnoresEndsOfEdges) {
  EXPECT_EQ(findJunctions(test::cube()).found.count, 0u);
  // Separate vertices at the same position.
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 0, 0}, {0, -1, 0}};
  mesh.triangles = {{0, 1, 2}, {3, 4, 5}};
  EXPECT_EQ(findJunctions(mesh).found.count, 0u);
}

}  // namespace
}  // namespace malus::prep
