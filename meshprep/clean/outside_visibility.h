// Sides of a surface that are visible from far outside. Of a building without a floor or with open doors, more
// directions are free in front of the outer side of a wall than in front of the inner one.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "meshprep/mesh.h"

namespace malus::prep {

// Shares of the directions in which nothing hides a side of the surface, from 0 to 1.
struct VisibleShares {
  double front = 0;  // the side of the normals
  double back = 0;
};

class OutsideVisibility {
 public:
  // All triangles of the mesh hide others. `mesh` must outlive this object, and its vertices must not change.
  explicit OutsideVisibility(const Mesh& mesh);
  ~OutsideVisibility();
  OutsideVisibility(const OutsideVisibility&) = delete;
  OutsideVisibility& operator=(const OutsideVisibility&) = delete;

  // Samples 32 points of these triangles, evenly by area, with 12 directions per side. flipped: one per triangle of the
  // mesh, 1 if the normal of the triangle is to be reversed. The result does not depend on the order of calls.
  VisibleShares sample(std::span<const std::uint32_t> triangles, const std::vector<char>& flipped) const;

 private:
  struct Index;
  const Mesh& mesh_;
  std::unique_ptr<Index> index_;
};

}  // namespace malus::prep
