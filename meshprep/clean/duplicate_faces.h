// Removal of triangles with the same three vertices and orientation as an earlier one. Those with the opposite
// orientation are the back of a wall without thickness, or a face that two bodies share: they are reported, and removed
// only on request.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DuplicateFaces {
  Findings same;      // dropped: orientation of the earlier one
  Findings opposite;  // opposite orientation; dropped if dropOpposite
};

DuplicateFaces dropDuplicateFaces(Mesh& mesh, bool dropOpposite);

}  // namespace malus::prep
