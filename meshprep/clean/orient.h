// Consistent orientation of the faces of a surface.
//
// Components are connected through edges of exactly two triangles. The triangles of a component are made consistent;
// the majority keeps its orientation (by number; with equal numbers, that of the first triangle). Then, unless the mesh
// is an open surface:
// - an open component whose triangles contradicted each other shows outward the side that is visible from outside in
//   more directions (outside_visibility.h), because the majority may be small details inside of a building. Without a
//   clear difference the majority decides;
// - a closed component with a negative signed volume is flipped as a whole, so that its normals point outward;
// - a closed component inside an odd number of others (a cavity, or a body in a body; only the file knows which) is
//   flipped if and only if the smallest component around it is, so that their relative orientation is kept.
// Other open components, components without volume and open surfaces keep the orientation of the majority. Components
// that are not orientable (Moebius strip) are not changed, nor those of which a flipped triangle would become equal to
// one that was back to back with it: a doubled surface keeps its two sides.
//
// Source: signed volume as a sum of tetrahedra: C. Zhang and T. Chen, "Efficient feature extraction for 2D/3D objects
// in mesh representation", ICIP 2001. Inside by winding number (shell_nesting.h).
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "meshprep/clean/component.h"
#include "meshprep/clean/edges.h"
#include "meshprep/findings.h"

namespace malus::prep {

struct OrientResult {
  std::vector<Component> components;       // in the order of their first triangles
  std::vector<std::uint32_t> componentOf;  // index into components, per triangle
  Findings flipped;                        // flipped triangles
  bool applied = true;                     // false: the mesh is unchanged, and this is what orient() would do
  std::uint64_t nested = 0;                // components oriented relative to the one around them
  std::uint64_t orientedByVisibility = 0;  // open components with contradictions, decided by visibility
  std::uint64_t orientedByMajority = 0;    // those whose visibility does not decide, or that are too many to test
  std::uint64_t keptDoubled = 0;           // components not flipped, because a triangle would become a duplicate
  std::uint64_t notOrientable = 0;         // components that are not orientable
  std::uint64_t withoutVolume = 0;         // closed components without volume, which have no outside
  std::uint64_t boundaryEdges = 0;         // edges of one triangle
  std::uint64_t nonManifoldEdges = 0;      // edges of three or more triangles
  std::uint64_t nestingUnchecked = 0;      // closed components, if they are too many to compare; else 0
};

// Triangles must have three different vertices. Keeps the order of triangles and the first vertex of each.
// edges: edgeUses() of the triangles.
OrientResult orient(Mesh& mesh, bool openSurface, std::span<const EdgeUse> edges);
OrientResult orient(Mesh& mesh, bool openSurface);

}  // namespace malus::prep
