// Takes out triangles that cover nothing: two corners are the same vertex, or the three lie on a line within the
// rounding of double. Order of the others is kept; vertices stay.
//
// A triangle whose middle corner lies on its longest edge closes the surface between the neighbours of its short edges
// and the one neighbour of its long edge. That neighbour is cut in two at the middle corner, so that the surface
// stays closed and no T-junction is left; where there is no such neighbour, or more than one, the triangle goes alone.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DegenerateFaces {
  Findings repeatedCorner;  // dropped
  Findings zeroArea;        // dropped: twice the area is at most 1e-12 of the longest edge squared
  Findings neighboursCut;   // cut in two beside one of zero area
};

DegenerateFaces dropDegenerateFaces(Mesh& mesh);

}  // namespace malus::prep
