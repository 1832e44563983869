#include "meshprep/clean/unreferenced_vertices.h"

#include <gtest/gtest.h>

#include "meshprep/mesh.h"

namespace malus::prep {
namespace {

TEST(UnreferencedVertices, AreDroppedInOrder) {
  Mesh mesh;
  mesh.positions = {{9, 0, 0}, {0, 0, 0}, {8, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 0, 0}};
  mesh.triangles = {{4, 1, 3}};
  EXPECT_EQ(dropUnreferencedVertices(mesh).count, 3u);
  EXPECT_EQ(mesh.positions, (std::vector<glm::dvec3>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{2, 0, 1}}));
  EXPECT_EQ(dropUnreferencedVertices(mesh).count, 0u);
}

}  // namespace
}  // namespace malus::prep
