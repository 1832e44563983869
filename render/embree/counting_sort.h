// Stable order of items by small keys: counting sort.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

namespace malus::embree {

// keys: of `count` items, each less than ends.size(). Items are taken in runs of runLength, the last one may be
// shorter; hasOneKey(first): whether the run that begins there is complete and has one key. order: gets the indices of
// the items, those of key 0 first. ends: gets, for each key, the number of items with at most this key.
template <class HasOneKey>
[[gnu::always_inline]] inline void countingSort(const std::uint32_t* keys, std::uint32_t count, std::uint32_t runLength,
                                                HasOneKey hasOneKey, std::span<std::uint32_t> ends,
                                                std::uint32_t* order) {
  std::ranges::fill(ends, 0u);
  for (std::uint32_t first = 0; first < count; first += runLength) {
    if (hasOneKey(first))
      ends[keys[first]] += runLength;
    else
      for (std::uint32_t i = first; i < std::min(first + runLength, count); ++i) ++ends[keys[i]];
  }
  std::uint32_t sum = 0;
  for (std::uint32_t& end : ends) {
    const std::uint32_t size = end;
    end = sum;
    sum += size;
  }
  for (std::uint32_t first = 0; first < count; first += runLength) {
    if (hasOneKey(first)) {
      std::uint32_t& end = ends[keys[first]];
      for (std::uint32_t i = 0; i < runLength; ++i) order[end + i] = first + i;
      end += runLength;
    } else {
      for (std::uint32_t i = first; i < std::min(first + runLength, count); ++i) order[ends[keys[i]]++] = i;
    }
  }
}

inline void countingSort(const std::uint32_t* keys, std::uint32_t count, std::span<std::uint32_t> ends,
                         std::uint32_t* order) {
  countingSort(
      keys, count, 1, [](std::uint32_t) { return true; }, ends, order);
}

}  // namespace malus::embree
