// Conversion between prep::Mesh and OpenMesh's half-edge structure.
//
// OpenMesh represents oriented manifolds only, so a mesh can be converted after the steps orient and fans of cleaning.
// Coordinates stay double. Vertex i and triangle i of a mesh have the handles i of the half-edge mesh, so that
// everything else that prep::Mesh stores per vertex or triangle (sources, smoothing groups) is found by the index of
// the handle.
#pragma once

#include <OpenMesh/Core/Mesh/Attributes.hh>
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <glm/vec3.hpp>

#include "meshprep/mesh.h"

namespace malus::prep {

struct HalfEdgeTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
  VertexAttributes(OpenMesh::Attributes::Status);
  EdgeAttributes(OpenMesh::Attributes::Status);
  FaceAttributes(OpenMesh::Attributes::Status);
};
using HalfEdgeMesh = OpenMesh::TriMesh_ArrayKernelT<HalfEdgeTraits>;

// Triangles must have three different vertices. Throws Error that names the source face if the mesh is not an oriented
// manifold: an edge with three triangles or with two of opposite orientation, a vertex with two fans.
HalfEdgeMesh toHalfEdges(const Mesh& mesh);

// The vertices and triangles of `source`, from which `halfEdges` was converted, that are not deleted, in their order.
// Triangles get the corners that they have in `halfEdges`; everything else comes from `source`. Corner normals are
// dropped, because corners may have moved to other vertices. No vertex may have moved.
Mesh fromHalfEdges(const HalfEdgeMesh& halfEdges, const Mesh& source);

inline glm::dvec3 toGlm(const OpenMesh::Vec3d& v) { return {v[0], v[1], v[2]}; }
inline OpenMesh::Vec3d toOpenMesh(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

}  // namespace malus::prep
