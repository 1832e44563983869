// Detection of pairs of triangles that cross, coincide, or touch outside of shared corners. They are reported and not
// repaired. The inside of such a surface is not defined.
//
// Triangles that share corners (by position) must not touch elsewhere. The tests are exact for the double coordinates:
// floating point with error bounds (separation.h) decides most pairs, CGAL's kernel with exact predicates the others.
// A hierarchy of bounding boxes (box_pairs.h) finds the pairs to test, and around a vertex of many triangles one of
// directions.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/vec3.hpp>

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

// The same for some pairs of triangles.
Intersections testPairs(std::span<const glm::dvec3> positions, std::span<const glm::uvec3> triangles,
                        std::span<const Intersections::Pair> pairs);

// Returns the pairs, sorted, that may be in the result of findIntersections() if every vertex moves by at most this
// distance, and vertices at one position together. Nothing if there are too many pairs to test, or a vertex of many
// triangles.
std::optional<std::vector<Intersections::Pair>> findClosePairs(const Mesh& mesh, double distance);

// Returns a finding per pair, halfway between the triangles.
Findings describePairs(const Mesh& mesh, const std::vector<Intersections::Pair>& pairs);

}  // namespace malus::prep
