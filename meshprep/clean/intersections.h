// Triangles that run through each other, lie on each other or touch where they are not joined, as pairs. They are told
// and left: what is inside of such a surface is not defined.
//
// Triangles that share corners (by position) are joined there; one of them must then touch the other nowhere else. The
// tests are exact for the coordinates as doubles (CGAL's kernel with exact predicates); what an R-tree of their boxes
// keeps apart is not tested.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "meshprep/findings.h"

namespace malus::prep {

struct Intersections {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // triangles of the mesh, the smaller first
  std::vector<Pair> crossing;                            // sorted
  std::vector<Pair> coincident;                          // the same three places; sorted
  bool complete = true;                                  // false, and the lists empty, where there are too many to test
};

// Triangles without area are left out.
Intersections findIntersections(const Mesh& mesh);

Findings describePairs(const Mesh& mesh, const std::vector<Intersections::Pair>& pairs);

}  // namespace malus::prep
