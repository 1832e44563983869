// Makes vertices at the same place one vertex. With a tolerance, a vertex joins the nearest kept vertex that
// is no farther than the tolerance (metres), the earlier one where two are as near; kept vertices are then
// farther than the tolerance from each other, so chains of close vertices do not collapse into one point.
// The first vertex of a place stays and keeps its position; order is kept.
// Source: spatial hashing after M. Teschner et al., "Optimized spatial hashing for collision detection of
// deformable objects", VMV 2003.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

// Returns how many vertices joined another. Positive and negative zero are equal. tolerance 0: equal
// positions only. Throws Error where the tolerance is too small against the coordinates to divide space by.
std::uint64_t weld(Mesh& mesh, double tolerance);

}  // namespace malus::prep
