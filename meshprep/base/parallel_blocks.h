// Loops over blocks of a range by all threads of the current TBB arena, with results that do not depend on the number
// of threads. For targets that link TBB.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <vector>

#include <oneapi/tbb/parallel_for.h>

namespace malus {

inline constexpr std::size_t kParallelBlock = 1u << 14u;

constexpr std::size_t countBlocks(std::size_t count) { return (count + kParallelBlock - 1) / kParallelBlock; }

// Calls run(block, first, last) for blocks of the numbers 0 to count - 1.
template <class Run>
void forBlocks(std::size_t count, Run run) {
  oneapi::tbb::parallel_for(std::size_t{0}, countBlocks(count), [&](std::size_t block) {
    run(block, block * kParallelBlock, std::min(count, (block + 1) * kParallelBlock));
  });
}

// Calls run(i) for the numbers 0 to count - 1.
template <class Run>
void forNumbers(std::size_t count, Run run) {
  forBlocks(count, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i) run(i);
  });
}

// Calls add(first, last, list) for blocks of the numbers 0 to count - 1, and returns the lists in order.
template <class T, class Add>
std::vector<T> collectBlocks(std::size_t count, Add add) {
  std::vector<std::vector<T>> lists(countBlocks(count));
  forBlocks(count, [&](std::size_t block, std::size_t first, std::size_t last) { add(first, last, lists[block]); });
  std::size_t size = 0;
  for (const std::vector<T>& list : lists) size += list.size();
  std::vector<T> all;
  all.reserve(size);
  for (const std::vector<T>& list : lists) all.insert(all.end(), list.begin(), list.end());
  return all;
}

// Returns true if test(i) is true for all numbers from 0 to count - 1. Stops at the first for which it is not.
template <class Test>
bool allNumbers(std::size_t count, Test test) {
  std::atomic<bool> all{true};
  forBlocks(count, [&](std::size_t, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last && all.load(std::memory_order_relaxed); ++i)
      if (!test(i)) all.store(false, std::memory_order_relaxed);
  });
  return all;
}

}  // namespace malus
