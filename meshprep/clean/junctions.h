// Detection of T-junctions: vertices of a boundary that are on another boundary edge, between its ends. Light can leak
// there, and the surface is open although it looks closed. They are reported and not repaired.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

// Largest distance between vertex and edge, relative to the edge's length; covers coordinates with few decimals.
inline constexpr double kJunctionTolerance = 1e-6;

struct Junctions {
  Findings found;        // vertices: the junction, then the ends of the edge; faces: that of the edge
  bool complete = true;  // false: too many candidates to test, and nothing is found
};

Junctions findJunctions(const Mesh& mesh);

}  // namespace malus::prep
