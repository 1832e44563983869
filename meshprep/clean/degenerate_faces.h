// Removal of triangles without area: with a repeated vertex, or with collinear corners within rounding errors of
// double. Keeps the order of the others, and all vertices. Keeps the surface closed:
//
// - A triangle with an edge of negligible length is removed by collapsing that edge into its first vertex.
// - If the middle corner is on the longest edge, the neighbour there is cut at the middle corner, and one half takes
// the
//   index of the degenerate triangle, so that no T-junction is left. This needs exactly one neighbour with area; chains
//   are processed from their ends. Otherwise the triangle is removed without repair.
#pragma once

#include "meshprep/findings.h"

namespace malus::prep {

struct DegenerateFaces {
  Findings repeatedCorner;  // dropped
  Findings zeroArea;        // dropped: twice the area is at most 1e-12 of the longest edge squared
  Findings edgesCollapsed;  // edges of at most 1e-9 of the longest of their triangle, removed with it
  Findings neighboursCut;   // triangles cut in two beside one of zero area
  bool changed() const { return repeatedCorner.count + zeroArea.count + edgesCollapsed.count > 0; }
};

DegenerateFaces dropDegenerateFaces(Mesh& mesh);

// Returns true if twice the area is at most 1e-12 of the longest edge squared.
bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

}  // namespace malus::prep
