#include "meshprep/clean/duplicate_faces.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

Mesh copies() {
  Mesh mesh = test::cube();
  mesh.triangles = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 2, 3}};
  return mesh;
}

TEST(DuplicateFaces, EveryTurnIsACopyAndTheBackIsOpposite) {
  Mesh mesh = copies();
  const DuplicateCounts counts = dropDuplicateFaces(mesh, false);
  EXPECT_EQ(counts.same, 2u);
  EXPECT_EQ(counts.opposite, 2u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 2, 3}}));
}

TEST(DuplicateFaces, ASheetKeepsItsBackOnce) {
  Mesh mesh = copies();
  const DuplicateCounts counts = dropDuplicateFaces(mesh, true);
  EXPECT_EQ(counts.same, 3u);
  EXPECT_EQ(counts.opposite, 0u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 1}, {1, 2, 3}}));
}

TEST(DuplicateFaces, ACubeHasNone) {
  Mesh mesh = test::cube();
  const DuplicateCounts counts = dropDuplicateFaces(mesh, false);
  EXPECT_EQ(counts.same + counts.opposite, 0u);
  EXPECT_EQ(mesh.triangles, test::cube().triangles);
}

}  // namespace
}  // namespace malus::prep
