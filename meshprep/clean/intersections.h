// Detection of pairs of triangles that cross, coincide, or touch outside of shared corners. They are reported and not
// repaired. The inside of such a surface is not defined.
//
// Triangles that share corners (by position) must not touch elsewhere. The tests are exact for the double coordinates
// (CGAL's kernel with exact predicates). An R-tree of bounding boxes (box_pairs.h) finds the pairs to test.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "meshprep/findings.h"

namespace malus::prep {

struct Intersections {
  using Pair = std::pair<std::uint32_t, std::uint32_t>;  // triangles of the mesh, the smaller first
  std::vector<Pair> crossing;                            // sorted
  std::vector<Pair> coincident;                          // the same three positions; sorted
  bool complete = true;                                  // false: too many pairs to test, and the lists are empty
};

// Ignores triangles without area.
Intersections findIntersections(const Mesh& mesh);

// Returns a finding per pair, halfway between the triangles.
Findings describePairs(const Mesh& mesh, const std::vector<Intersections::Pair>& pairs);

}  // namespace malus::prep
