// Drops triangles that cover nothing: two corners are the same vertex, or the three lie on a line within the
// rounding of double. Order of the others is kept; vertices stay.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

struct DegenerateCounts {
  std::uint64_t repeatedCorner = 0;
  std::uint64_t zeroArea = 0;  // twice the area is at most 1e-12 of the longest edge squared
};

DegenerateCounts dropDegenerateFaces(Mesh& mesh);

}  // namespace malus::prep
