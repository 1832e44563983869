// Takes out triangles that cover nothing: two corners are the same vertex, or the three lie on a line within the
// rounding of double. Order of the others is kept; vertices stay. Where such a triangle closes the surface between its
// neighbours, the surface stays closed:
//
// - One with a short edge, of no length beside the others, goes with that edge: the edge's second vertex becomes the
//   first.
// - One whose middle corner lies on its longest edge hands its place to half of the neighbour there, which is cut at
//   the middle corner: no T-junction is left. The neighbour must be one, and have area; chains of such triangles are
//   worked off from their ends. Where there is none, or more than one, the triangle goes alone.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DegenerateFaces {
  Findings repeatedCorner;  // dropped
  Findings zeroArea;        // dropped: twice the area is at most 1e-12 of the longest edge squared
  Findings edgesCollapsed;  // an edge of at most 1e-9 of the longest one of its triangle, gone with that triangle
  Findings neighboursCut;   // cut in two beside one of zero area
  bool changed() const { return repeatedCorner.count + zeroArea.count + edgesCollapsed.count > 0; }
};

DegenerateFaces dropDegenerateFaces(Mesh& mesh);

// Whether a triangle covers nothing.
bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace malus::prep
