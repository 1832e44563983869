// Detection of pairs of triangles that cross, coincide, or touch outside of shared corners. They are reported and not
// repaired. The inside of such a surface is not defined.
//
// Triangles that share corners (by position) must not touch elsewhere. The tests are exact for the double coordinates:
// floating point with error bounds (separation.h) decides most pairs, CGAL's kernel with exact predicates the others.
// A hierarchy of bounding boxes (box_pairs.h) finds the pairs to test, and around a vertex of many triangles one of
// directions.
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
  std::uint64_t exactTests = 0;                          // pairs that floating point did not decide
  bool complete = true;                                  // false: too many pairs to test (of long thin faces, or faces
                                                         // around one vertex), and the lists are empty
};

// Ignores triangles without area. Finds the pairs with at least one triangle from `first` on.
Intersections findIntersections(const Mesh& mesh, std::size_t first = 0);

// Returns a finding per pair, halfway between the triangles.
Findings describePairs(const Mesh& mesh, const std::vector<Intersections::Pair>& pairs);

}  // namespace malus::prep
