// Pairs of overlapping boxes of one or two lists, found by bounding volume hierarchies. A leaf of eight boxes is tested
// as one against the tree, which takes a quarter of the time of a query per box to the R-tree of Boost.Geometry.
// Source: J. T. Klosowski, M. Held, J. S. B. Mitchell, H. Sowizral, K. Zikan, "Efficient collision detection using
// bounding volume hierarchies of k-DOPs", IEEE TVCG 4(1), 1998.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Box {
  glm::dvec3 low, high;  // corners, low <= high
};

// Whether the boxes overlap or touch. Compares without branches, which processors would mispredict.
inline bool overlap(const Box& a, const Box& b) {
  return (static_cast<int>(a.low.x <= b.high.x) & static_cast<int>(b.low.x <= a.high.x) &
          static_cast<int>(a.low.y <= b.high.y) & static_cast<int>(b.low.y <= a.high.y) &
          static_cast<int>(a.low.z <= b.high.z) & static_cast<int>(b.low.z <= a.high.z)) != 0;
}

// Calls visit(i, j) for every a[i] and b[j] that overlap or touch, from several threads and in any order. visit returns
// the cost of the pair. Returns false if the costs exceed `most`; the visited pairs then depend on the timing of the
// threads and must be discarded.
bool forOverlappingBoxes(std::span<const Box> a, std::span<const Box> b, std::uint64_t most,
                         const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& visit);

// The same for i > j of one list.
bool forOverlappingPairs(std::span<const Box> boxes, std::uint64_t most,
                         const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& visit);

}  // namespace malus::prep
