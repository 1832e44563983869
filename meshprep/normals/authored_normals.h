// Normals as the file has them, one a corner: corners of a vertex with equal normals share a vertex, others do not.
// Corners without one, or with one of no length, get what the crease angle gives them (crease_normals.h).
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

// mesh.cornerNormals must be there. Where a triangle was turned over (mesh.flipped), its normals turn with it if all of
// them would point to its back. Vertices keep their order, those of one vertex by their first corners; one of no
// triangle stays, with any normal.
AuthoredNormals addAuthoredNormals(Mesh& mesh, double creaseDegrees);

}  // namespace malus::prep
