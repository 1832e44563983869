// Contacts of the faces of a certified mesh after rounding.
//
// A mesh in pieces (instances.h) is not searched as a whole. Pieces whose rounded boxes overlap or touch are searched
// together. Pieces of one shape have the same pairs of faces that are so close that a displacement of the vertices by
// their rounding errors may make them touch (findClosePairs()): these are found once, in the first of the pieces, and
// tested in each. The result is that of a search in the whole mesh.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/clean/intersections.h"
#include "meshprep/mesh.h"

namespace malus::prep {

class RoundedContacts {
 public:
  // The mesh must outlive this.
  explicit RoundedContacts(const Mesh& mesh) : mesh_(mesh) {}

  // Returns the pairs of triangles that cross, touch or coincide at these positions of the vertices, sorted.
  std::vector<Intersections::Pair> find(std::span<const glm::dvec3> rounded);

  std::size_t searchedTriangles() const { return searchedTriangles_; }  // by find(), so far

 private:
  const Mesh& mesh_;
  std::size_t searchedTriangles_ = 0;
};

}  // namespace malus::prep
