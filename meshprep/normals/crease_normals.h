// Normals where the surface is smooth except over its sharp edges: an edge is smooth where the normals of its two
// triangles differ by no more than the crease angle (piece_normals.h).
#pragma once

#include "meshprep/normals/piece_normals.h"

namespace malus::prep {

// creaseDegrees from 0 to 180; an edge of exactly that angle is smooth.
NormalCounts addCreaseNormals(Mesh& mesh, double creaseDegrees);

}  // namespace malus::prep
