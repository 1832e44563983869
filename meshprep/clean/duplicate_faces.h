// Drops triangles that name the same three vertices as an earlier one, the same way around: copies. One that names
// them the other way around is the back of a wall without thickness, or a face that two bodies share: it stays, and
// is told, unless its dropping is asked for.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DuplicateFaces {
  Findings same;      // dropped: the same way around as an earlier one
  Findings opposite;  // the other way around: dropped with dropOpposite, else left
};

DuplicateFaces dropDuplicateFaces(Mesh& mesh, bool dropOpposite);

}  // namespace malus::prep
