// A decimation module of OpenMesh that keeps creases where they are.
//
// A collapse is illegal if an edge that is not a feature would become sharper than the crease angle. Features stay
// features where two edges become one.
// Source of the module interface: OpenMesh, "Mesh Decimation Framework", OpenMesh/Tools/Decimater/ModBaseT.hh.
#pragma once

#include <string>

#include <OpenMesh/Tools/Decimater/ModBaseT.hh>

#include "meshprep/halfedge/half_edge_mesh.h"

namespace malus::prep {

class KeepCreases : public OpenMesh::Decimater::ModBaseT<HalfEdgeMesh> {
 public:
  // The declarations that DECIMATING_MODULE makes for class templates.
  using Handle = OpenMesh::Decimater::ModHandleT<KeepCreases>;
  using Base = OpenMesh::Decimater::ModBaseT<HalfEdgeMesh>;
  using Mesh = Base::Mesh;
  using CollapseInfo = Base::CollapseInfo;
  const std::string& name() const override {
    static const std::string kName = "KeepCreases";
    return kName;
  }

  explicit KeepCreases(HalfEdgeMesh& mesh) : Base(mesh, true) {}

  // Cosine of the crease angle; -1: collapses may make edges of any angle.
  void setMinCosine(double cosine) { minCosine_ = cosine; }

  float collapse_priority(const CollapseInfo& collapse) override;
  void preprocess_collapse(const CollapseInfo& collapse) override;
  void postprocess_collapse(const CollapseInfo& collapse) override;

 private:
  bool isFeature(OpenMesh::HalfedgeHandle h) {
    return h.is_valid() && Base::mesh().status(Base::mesh().edge_handle(h)).feature();
  }
  bool makesCrease(const CollapseInfo& collapse);

  double minCosine_ = -1;
  bool leftIsFeature_ = false, rightIsFeature_ = false;  // of the collapse in progress
};

}  // namespace malus::prep
