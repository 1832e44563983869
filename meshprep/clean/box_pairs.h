// Which boxes of two lists overlap: the first look before an exact test. An R-tree (Boost.Geometry) finds them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include <glm/vec3.hpp>

namespace malus::prep {

struct Box {
  glm::dvec3 low, high;
};

// Calls visit(i, j) for every a[i] and b[j] that overlap or touch, from several threads at once and in any order; it
// tells whether the pair was worth counting. Returns false where more than `most` were: then some were left out, which
// ones depends on the threads, and the caller should forget what it saw.
bool forOverlappingBoxes(std::span<const Box> a, std::span<const Box> b, std::uint64_t most,
                         const std::function<bool(std::uint32_t, std::uint32_t)>& visit);

}  // namespace malus::prep
