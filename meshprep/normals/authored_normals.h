// Normals of the file, one per corner. Corners of a vertex with equal normals share a vertex, others do not. Corners
// without a normal, or with one of length 0, get that of the crease angle (crease_normals.h).
#pragma once

#include <cstdint>

#include "meshprep/findings.h"
#include "meshprep/normals/piece_normals.h"

namespace malus::prep {

struct AuthoredNormals {
  NormalCounts counts;
  std::uint64_t missing = 0;  // corners that got another normal
  Findings against;           // triangles with a normal that points to their back
};

// mesh.cornerNormals must not be empty. The normals of a flipped triangle (mesh.flipped) are negated if all of them
// would point to its back. Vertices keep their order, those of one vertex by their first corners; one of no triangle
// stays, with any normal.
AuthoredNormals addAuthoredNormals(Mesh& mesh, double creaseDegrees);

}  // namespace malus::prep
