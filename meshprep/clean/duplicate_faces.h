// Removal of triangles with the same three vertices and orientation as an earlier one. Those with the opposite
// orientation are the back of a wall without thickness, or a face that two bodies share: they are reported, and removed
// only on request.
//
// A wall between two touching bodies, of which one is inside out, has two faces of the same orientation, and each
// closes a body. Such a pair is kept if at every border edge of the connected pairs two other faces meet, one per body,
// so that one face less would leave an open edge. A face that only occurs twice has one neighbour there, or none. If
// the pair shares vertices of the file, as a face that is written twice does, both other faces must also continue the
// orientation of the pair, and all faces that are connected with it must form closed surfaces.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DuplicateFaces {
  Findings same;      // dropped: orientation of the earlier one
  Findings walls;     // kept: orientation of the earlier one, but each of them closes a body
  Findings opposite;  // opposite orientation; dropped if dropOpposite
};

DuplicateFaces dropDuplicateFaces(Mesh& mesh, bool dropOpposite);

}  // namespace malus::prep
