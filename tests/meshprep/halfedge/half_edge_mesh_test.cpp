#include "meshprep/halfedge/half_edge_mesh.h"

#include <gtest/gtest.h>

#include "tests/meshprep/shapes.h"

namespace malus::prep {
namespace {

TEST(HalfEdgeMesh, RoundTripKeepsEverything) {
  Mesh mesh = test::joined(test::sphere(6, 9), test::cube(0.3, glm::dvec3(1.0 / 3, 1e-300, 1e300)));
  for (std::uint32_t i = 0; i < mesh.positions.size(); ++i) mesh.sourceVertices.push_back(3 * i);
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) {
    mesh.sourceFaces.push_back(i / 2);
    mesh.sourceCorners.push_back(3u * mesh.triangles[i]);
    mesh.smoothingGroups.push_back(i % 3);
    mesh.flipped.push_back(static_cast<char>(i % 2));
  }
  const Mesh back = fromHalfEdges(toHalfEdges(mesh), mesh);
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.sourceVertices, mesh.sourceVertices);
  EXPECT_EQ(back.sourceFaces, mesh.sourceFaces);
  EXPECT_EQ(back.sourceCorners, mesh.sourceCorners);
  EXPECT_EQ(back.smoothingGroups, mesh.smoothingGroups);
  EXPECT_EQ(back.flipped, mesh.flipped);
}

TEST(HalfEdgeMesh, LeavesOutWhatIsDeleted) {
  Mesh mesh = test::joined(test::cube(), test::cube(1, glm::dvec3(5)));
  for (std::uint32_t i = 0; i < mesh.triangles.size(); ++i) mesh.sourceFaces.push_back(100 + i);
  HalfEdgeMesh halfEdges = toHalfEdges(mesh);
  for (int f = 0; f < 12; ++f) halfEdges.delete_face(OpenMesh::FaceHandle(f));  // and the vertices that it leaves
  const Mesh back = fromHalfEdges(halfEdges, mesh);
  EXPECT_EQ(back.triangles, test::cube().triangles);
  EXPECT_EQ(back.positions, test::cube(1, glm::dvec3(5)).positions);
  EXPECT_EQ(back.sourceFaces.front(), 112u);
}

TEST(HalfEdgeMesh, RefusesWhatIsNotAnOrientedManifold) {
  Mesh fin = test::cube();
  fin.positions.emplace_back(2, 2, 2);
  fin.triangles.emplace_back(0, 1, 8);
  EXPECT_TRUE(test::contains(test::errorMessage([&] { toHalfEdges(fin); }), "face 12"));
  Mesh flipped = test::cube();
  std::swap(flipped.triangles[3].y, flipped.triangles[3].z);
  EXPECT_TRUE(test::contains(test::errorMessage([&] { toHalfEdges(flipped); }), "oriented manifold"));
}

}  // namespace
}  // namespace malus::prep
