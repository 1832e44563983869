// Makes vertices at the same place one vertex. With a tolerance, a vertex joins the nearest kept vertex that
// is no farther than the tolerance (metres), the earlier one where two are as near; kept vertices are then
// farther than the tolerance from each other (but for those left apart, below), so chains of close vertices do not
// collapse into one point. The first vertex of a place stays and keeps its position; order is kept.
//
// Vertices that only the tolerance joins are left apart where joining them would make one edge of several and put a
// third triangle on it: the surface there is thinner than the tolerance. Vertices that no triangle names join only what
// is at their very place.
// Source: spatial hashing after M. Teschner et al., "Optimized spatial hashing for collision detection of
// deformable objects", VMV 2003.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct Weld {
  Findings joined;   // vertices that became another
  Findings refused;  // vertices left apart, though the tolerance would join them
};

// Positive and negative zero are equal. tolerance 0: equal positions only. Throws Error where the tolerance is too
// small against the coordinates to divide space by.
Weld weld(Mesh& mesh, double tolerance);

}  // namespace malus::prep
