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

TEST(DuplicateFaces, DropsCopiesAndKeepsTheBack) {
  Mesh mesh = copies();
  const DuplicateFaces result = dropDuplicateFaces(mesh, false);
  EXPECT_EQ(result.same.count, 3u);
  EXPECT_EQ(result.opposite.count, 1u);
  EXPECT_EQ(result.opposite.first[0].faces, (std::vector<std::uint32_t>{3, 0}));
  EXPECT_EQ(result.same.first[2].faces, (std::vector<std::uint32_t>{4, 3}));
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {0, 2, 1}, {1, 2, 3}}));
}

TEST(DuplicateFaces, DropsTheBackOnRequest) {
  Mesh mesh = copies();
  const DuplicateFaces result = dropDuplicateFaces(mesh, true);
  EXPECT_EQ(result.same.count, 3u);
  EXPECT_EQ(result.opposite.count, 1u);
  EXPECT_EQ(mesh.triangles, (std::vector<glm::uvec3>{{0, 1, 2}, {1, 2, 3}}));
}

TEST(DuplicateFaces, FindsNoneInACube) {
  Mesh mesh = test::cube();
  const DuplicateFaces counts = dropDuplicateFaces(mesh, false);
  EXPECT_EQ(counts.same.count + counts.opposite.count, 0u);
  EXPECT_EQ(mesh.triangles, test::cube().triangles);
}

}  // namespace
}  // namespace malus::prep
