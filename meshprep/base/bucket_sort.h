// Sorting of items by a number, as a vertex, and then by a comparison. Several times faster than a sort of all items if
// there are few of each number. For targets that link TBB.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <vector>

#include "meshprep/base/parallel_blocks.h"

namespace malus {

template <class Item>
struct Buckets {
  std::vector<Item> items;
  std::vector<std::uint32_t> first;  // position of the first item of each number, and the number of items
};

// Sorts items of the numbers 0 to count - 1. forEach(visit) calls visit(number, item) for all items, and is called
// twice. less: a total order of the items of one number.
template <class Item, class ForEach, class Less>
Buckets<Item> sortInBuckets(std::size_t count, ForEach forEach, Less less) {
  // Count, then place the items of each number in the order of forEach().
  Buckets<Item> buckets;
  std::vector<std::uint32_t>& first = buckets.first;
  first.assign(count + 1, 0);
  forEach([&](std::size_t number, const Item&) { ++first[number + 1]; });
  std::partial_sum(first.begin(), first.end(), first.begin());
  buckets.items.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  forEach([&](std::size_t number, const Item& item) { buckets.items[next[number]++] = item; });

  // Sort those of each number.
  const auto at = [&](std::size_t number) { return buckets.items.begin() + first[number]; };
  forNumbers(count, [&](std::size_t number) { std::sort(at(number), at(number + 1), less); });
  return buckets;
}

}  // namespace malus
