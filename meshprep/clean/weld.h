// Welding of vertices. Vertices with equal positions become one. With a tolerance, a vertex joins the nearest kept
// vertex within the tolerance (metres), the earlier one of two at equal distances; kept vertices are then farther apart
// than the tolerance, so chains of close vertices do not collapse to a point. The first vertex keeps its position, and
// the order is kept.
//
// Vertices at different positions are not joined if that merges several edges into one with more than two triangles:
// the surface is thinner there than the tolerance. Vertices without triangles join only those with an equal position.
// Source: spatial hashing after M. Teschner et al., "Optimized spatial hashing for collision detection of deformable
// objects", VMV 2003.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct Weld {
  Findings joined;   // vertices joined to another
  Findings refused;  // vertices within the tolerance that were not joined
};

// tolerance: 0 for equal positions only; positive and negative zero are equal. Throws Error if a positive tolerance is
// too small for the coordinates (below 2^-53 of them).
Weld weld(Mesh& mesh, double tolerance);

}  // namespace malus::prep
