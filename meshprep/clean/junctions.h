// T-junctions: a vertex of a boundary that lies on another boundary edge, between its ends. Along it light can leak,
// and the surface is open where it looks closed. They are told as pairs of a vertex and an edge, and left.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

// Of the edge's length: what a vertex may be off and still lie on it, as coordinates of few decimals are.
inline constexpr double kJunctionTolerance = 1e-6;

struct Junctions {
  Findings found;        // vertices: the one on the edge, then the edge's; faces: the edge's
  bool complete = true;  // false, and nothing found, where there are too many candidates to look at
};

Junctions findJunctions(const Mesh& mesh);

}  // namespace malus::prep
