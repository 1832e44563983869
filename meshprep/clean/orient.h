// Turns triangles over so that the sides of a surface agree.
//
// A component is what hangs together through edges of exactly two triangles. Inside a component all
// triangles are made to agree; the majority (by number of triangles, the first one on a tie) keeps its side.
// Then, unless the mesh is a sheet:
// - a closed component is turned as a whole where its signed volume is negative: normals point outward;
// - but one that lies inside an odd number of other closed components (a cavity, or a body within a body:
//   the file alone knows) is turned if and only if the smallest component around it was: the two keep the
//   sides that they had to each other.
// Open components, components without volume and all of a sheet keep the majority's side. Components that
// have no two sides (a Moebius strip) stay as they are.
//
// Source: signed volume as the sum of tetrahedra, C. Zhang and T. Chen, "Efficient feature extraction for
// 2D/3D objects in mesh representation", ICIP 2001; inside by winding number with the solid angle of
// A. van Oosterom and J. Strackee, IEEE Trans. Biomedical Engineering 30(2), 1983.
#pragma once

#include <cstdint>
#include <vector>

#include "meshprep/clean/component.h"
#include "meshprep/findings.h"

namespace malus::prep {

struct OrientResult {
  std::vector<Component> components;       // in the order of their first triangles
  std::vector<std::uint32_t> componentOf;  // of every triangle
  Findings flipped;                        // triangles turned over
  bool applied = true;                     // false where the mesh was left as it is, and this tells what would be done
  std::uint64_t nested = 0;                // components kept with the one around them
  std::uint64_t notOrientable = 0;         // components without two sides
  std::uint64_t withoutVolume = 0;         // closed components whose outside cannot be told
  std::uint64_t boundaryEdges = 0;         // edges of one triangle
  std::uint64_t nonManifoldEdges = 0;      // edges of three or more
  std::uint64_t nestingUnchecked = 0;      // closed components where there are too many to compare
};

// Triangles must have three different vertices. Order is kept; a turned triangle keeps its first vertex.
OrientResult orient(Mesh& mesh, bool sheet);

}  // namespace malus::prep
