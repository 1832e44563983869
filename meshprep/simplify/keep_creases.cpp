#include "meshprep/simplify/keep_creases.h"

#include <OpenMesh/Tools/Decimater/CollapseInfoT.hh>

namespace malus::prep {

// With v0 at the position of v1, checks the edges of every triangle that keeps existing around v0.
bool KeepCreases::makesCrease(const CollapseInfo& c) {
  HalfEdgeMesh& mesh = Base::mesh();
  for (const OpenMesh::FaceHandle f : mesh.vf_range(c.v0)) {
    if (f == c.fl || f == c.fr) continue;
    const OpenMesh::Vec3d normal = mesh.calc_face_normal(f);
    for (const OpenMesh::HalfedgeHandle h : mesh.fh_range(f)) {
      OpenMesh::HalfedgeHandle across = mesh.opposite_halfedge_handle(h);
      bool feature = isFeature(h);
      // Beyond a triangle that the collapse removes is the next one.
      const OpenMesh::FaceHandle removed = mesh.face_handle(across);
      if (removed.is_valid() && (removed == c.fl || removed == c.fr)) {
        across = removed == c.fl ? c.vlv1 : c.v1vr;
        feature = feature || isFeature(across);
      }
      const OpenMesh::FaceHandle other = mesh.face_handle(across);
      if (!feature && other.is_valid() && (normal | mesh.calc_face_normal(other)) < minCosine_) return true;
    }
  }
  return false;
}

float KeepCreases::collapse_priority(const CollapseInfo& collapse) {
  if (minCosine_ <= -1) return static_cast<float>(Base::LEGAL_COLLAPSE);
  Base::mesh().set_point(collapse.v0, collapse.p1);
  const bool illegal = makesCrease(collapse);
  Base::mesh().set_point(collapse.v0, collapse.p0);
  return static_cast<float>(illegal ? Base::ILLEGAL_COLLAPSE : Base::LEGAL_COLLAPSE);
}

void KeepCreases::preprocess_collapse(const CollapseInfo& collapse) {
  leftIsFeature_ = isFeature(collapse.vlv1) || isFeature(collapse.v0vl);
  rightIsFeature_ = isFeature(collapse.v1vr) || isFeature(collapse.vrv0);
}

void KeepCreases::postprocess_collapse(const CollapseInfo& collapse) {
  HalfEdgeMesh& mesh = Base::mesh();
  const auto mark = [&](bool feature, OpenMesh::VertexHandle side) {
    if (!feature || !side.is_valid()) return;
    const OpenMesh::HalfedgeHandle h = mesh.find_halfedge(collapse.v1, side);
    if (h.is_valid()) mesh.status(mesh.edge_handle(h)).set_feature(true);
  };
  mark(leftIsFeature_, collapse.vl);
  mark(rightIsFeature_, collapse.vr);
}

}  // namespace malus::prep
