#include "meshprep/halfedge/half_edge_mesh.h"

#include <array>
#include <cstddef>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "meshprep/clean/select.h"
#include "meshprep/findings.h"

namespace malus::prep {

HalfEdgeMesh toHalfEdges(const Mesh& mesh) {
  HalfEdgeMesh result;
  result.reserve(mesh.positions.size(), mesh.triangles.size() * 3 / 2 + 3, mesh.triangles.size());
  for (const glm::dvec3& p : mesh.positions) result.add_vertex(toOpenMesh(p));
  const auto vertex = [](std::uint32_t i) { return OpenMesh::VertexHandle(static_cast<int>(i)); };
  omerr().disable();  // the exception reports the failure
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    const glm::uvec3& t = mesh.triangles[i];
    if (result.add_face(vertex(t.x), vertex(t.y), vertex(t.z)).is_valid()) continue;
    throw Error("mesh", fmt::format("source face {} does not fit into an oriented manifold", sourceFace(mesh, i)),
                "a mesh after the steps orient and fans of cleaning");
  }
  return result;
}

Mesh fromHalfEdges(const HalfEdgeMesh& halfEdges, const Mesh& source) {
  // Copy the triangles that are not deleted.
  Mesh mesh = source;
  mesh.cornerNormals.clear();
  mesh.normals.clear();
  for (const OpenMesh::FaceHandle f : halfEdges.all_faces()) {
    if (halfEdges.status(f).deleted()) continue;
    glm::uvec3& t = mesh.triangles[static_cast<std::size_t>(f.idx())];
    int corner = 0;
    glm::uvec3 corners{};
    for (const OpenMesh::VertexHandle v : halfEdges.fv_range(f))
      corners[corner++] = static_cast<std::uint32_t>(v.idx());
    // Keep the first corner of triangles that did not change.
    for (int turn = 0; turn < 3 && corners.x != t.x; ++turn) corners = {corners.y, corners.z, corners.x};
    if (corners != t && !mesh.sourceCorners.empty())
      mesh.sourceCorners[static_cast<std::size_t>(f.idx())] = {
          sourceVertex(mesh, corners.x), sourceVertex(mesh, corners.y), sourceVertex(mesh, corners.z)};
    t = corners;
  }
  keepTriangles(mesh,
                [&](std::size_t i) { return !halfEdges.status(OpenMesh::FaceHandle(static_cast<int>(i))).deleted(); });

  // Copy the vertices that are not deleted.
  std::vector<std::uint32_t> kept, newIndex(mesh.positions.size());
  for (std::size_t i = 0; i < newIndex.size(); ++i) {
    newIndex[i] = static_cast<std::uint32_t>(kept.size());
    if (!halfEdges.status(OpenMesh::VertexHandle(static_cast<int>(i))).deleted())
      kept.push_back(static_cast<std::uint32_t>(i));
  }
  selectVertices(mesh, kept, newIndex);
  return mesh;
}

}  // namespace malus::prep
