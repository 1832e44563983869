// Drops triangles that name the same three vertices as an earlier one. The same way around is a copy; the
// other way around is the back of a wall without thickness, which a sheet may want to keep.
#pragma once

#include <cstdint>

#include "meshprep/mesh.h"

namespace malus::prep {

struct DuplicateCounts {
  std::uint64_t same = 0;      // dropped, the same way around as an earlier one
  std::uint64_t opposite = 0;  // dropped, the other way around; always 0 with keepOpposite
};

DuplicateCounts dropDuplicateFaces(Mesh& mesh, bool keepOpposite);

}  // namespace malus::prep
