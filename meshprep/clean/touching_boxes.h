// Sets of boxes that overlap or touch, directly or by others between them.
#pragma once

#include <cstdint>
#include <limits>
#include <mutex>
#include <optional>
#include <span>

#include "meshprep/clean/box_pairs.h"
#include "meshprep/clean/disjoint_sets.h"

namespace malus::prep {

// Returns nothing if there are more than `most` pairs, in both orders and with each box itself.
inline std::optional<DisjointSets> touchingSets(std::span<const Box> boxes,
                                                std::uint64_t most = std::numeric_limits<std::uint64_t>::max()) {
  DisjointSets sets(boxes.size());
  std::mutex mutex;
  const auto merge = [&](std::uint32_t a, std::uint32_t b) {
    const std::scoped_lock lock(mutex);
    sets.merge(a, b);
    return 1u;
  };
  if (!forOverlappingBoxes(boxes, boxes, most, merge)) return std::nullopt;
  return sets;
}

}  // namespace malus::prep
