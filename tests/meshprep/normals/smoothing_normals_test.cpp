#include "meshprep/normals/smoothing_normals.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

TEST(SmoothingNormals, OneGroupIsSmoothWhateverTheAngle) {
  Mesh mesh = test::cube();
  mesh.smoothingGroups.assign(12, 7);
  EXPECT_EQ(addSmoothingNormals(mesh).added, 0u);
  for (std::size_t i = 0; i < 8; ++i)
    EXPECT_GT(glm::dot(glm::dvec3(mesh.normals[i]), glm::normalize(mesh.positions[i] - 0.5)), 0.999);
}

TEST(SmoothingNormals, GroupZeroIsFlatAndGroupsEndAtEachOther) {
  Mesh mesh = test::cube();
  mesh.smoothingGroups.assign(12, 0);
  // Not even the two triangles of a side share corners: 36 vertices.
  EXPECT_EQ(addSmoothingNormals(mesh).added, 28u);

  mesh = test::cube();
  for (std::uint32_t i = 0; i < 12; ++i) mesh.smoothingGroups.push_back(1 + i / 2);  // a group a side
  EXPECT_EQ(addSmoothingNormals(mesh).added, 16u);
}

}  // namespace
}  // namespace malus::prep
