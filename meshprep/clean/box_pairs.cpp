#include "meshprep/clean/box_pairs.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <glm/common.hpp>

#include "meshprep/base/parallel_blocks.h"
#include "meshprep/base/raw_array.h"

namespace malus::prep {

namespace {

using Visit = std::function<std::uint32_t(std::uint32_t, std::uint32_t)>;

constexpr std::uint64_t kBatch = 1024;        // cost between updates of the total
constexpr std::size_t kLeafBoxes = 8;         // at most
constexpr std::size_t kParallel = 1u << 14u;  // boxes of a subtree that is worth a task

Box unite(const Box& a, const Box& b) { return {glm::min(a.low, b.low), glm::max(a.high, b.high)}; }

// Number of levels below the root: the number of boxes of a node is halved until a leaf has at most kLeafBoxes.
unsigned countLevels(std::size_t boxes) {
  unsigned levels = 0;
  while (boxes > kLeafBoxes << levels) ++levels;
  return levels;
}

// Binary tree of boxes, split at the median along the longest axis. Node k has the children 2 k + 1 and 2 k + 2, and
// all leaves have the same level.
class BoxTree {
 public:
  explicit BoxTree(std::span<const Box> boxes) : boxes_(boxes.size()), numbers_(boxes.size()) {
    if (boxes.empty()) return;
    RawArray<Item> items(boxes.size());
    const glm::dvec3 origin = boxes.front().low;  // far from zero, the centres would be equal floats
    forNumbers(boxes.size(), [&](std::size_t i) {
      const glm::vec3 centre(0.5 * (boxes[i].low - origin) + 0.5 * (boxes[i].high - origin));
      items[i] = {{centre.x, centre.y, centre.z}, static_cast<std::uint32_t>(i)};
    });
    levels_ = countLevels(boxes.size());
    nodes_ = RawArray<Box>((std::size_t{2} << levels_) - 1);
    first_ = RawArray<std::uint32_t>((std::size_t{1} << levels_) + 1);
    first_[leafCount()] = static_cast<std::uint32_t>(boxes.size());
    build(boxes, items.data(), 0, boxes.size(), 0, 0);
  }

  std::size_t leafCount() const { return nodes_.size() == 0 ? 0 : first_.size() - 1; }
  const Box& leafBox(std::size_t leaf) const { return nodes_[leafCount() - 1 + leaf]; }
  std::uint32_t leafFirst(std::size_t leaf) const { return first_[leaf]; }
  std::uint32_t leafEnd(std::size_t leaf) const { return first_[leaf + 1]; }

  // Boxes in the order of the leaves, and their numbers in the list.
  const Box& box(std::size_t position) const { return boxes_[position]; }
  std::uint32_t number(std::size_t position) const { return numbers_[position]; }

  // Calls take(leaf) for each leaf from `from` on whose box overlaps this one.
  template <class Take>
  void forLeaves(const Box& box, std::size_t from, Take take) const {
    struct Node {
      std::size_t number;
      unsigned level;
    };
    std::array<Node, 64> stack{};
    std::size_t size = 0;
    if (nodes_.size() > 0) stack[size++] = {0, 0};
    while (size > 0) {
      const auto [node, level] = stack[--size];
      // The last leaf below it.
      const std::size_t end = ((node + 2) << (levels_ - level)) - (std::size_t{1} << levels_);
      if (end <= from || !overlap(nodes_[node], box)) continue;
      if (level == levels_) {
        take(end - 1);
        continue;
      }
      stack[size++] = {2 * node + 2, level + 1};
      stack[size++] = {2 * node + 1, level + 1};
    }
  }

 private:
  struct Item {
    std::array<float, 3> centre;
    std::uint32_t number;
  };

  Box build(std::span<const Box> boxes, Item* items, std::size_t first, std::size_t end, std::size_t node,
            unsigned level) {
    if (level == levels_) {
      const std::size_t leaf = node + 1 - (std::size_t{1} << levels_);
      first_[leaf] = static_cast<std::uint32_t>(first);
      constexpr double kMost = std::numeric_limits<double>::max();
      Box all{glm::dvec3(kMost), glm::dvec3(-kMost)};
      for (std::size_t i = first; i < end; ++i) {
        numbers_[i] = items[i].number;
        boxes_[i] = boxes[items[i].number];
        all = unite(all, boxes_[i]);
      }
      return nodes_[node] = all;
    }
    const std::size_t middle = first + (end - first) / 2;
    const std::size_t axis = longestAxis(items, first, end);
    std::nth_element(items + first, items + middle, items + end, [axis](const Item& a, const Item& b) {
      return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.number < b.number;
    });
    Box low{}, high{};
    const auto buildLow = [&] { low = build(boxes, items, first, middle, 2 * node + 1, level + 1); };
    const auto buildHigh = [&] { high = build(boxes, items, middle, end, 2 * node + 2, level + 1); };
    if (end - first > kParallel) {
      tbb::parallel_invoke(buildLow, buildHigh);
    } else {
      buildLow();
      buildHigh();
    }
    return nodes_[node] = unite(low, high);
  }

  static std::size_t longestAxis(const Item* items, std::size_t first, std::size_t end) {
    std::array<float, 3> low = items[first].centre, high = low;
    for (std::size_t i = first; i < end; ++i)
      for (std::size_t k = 0; k < 3; ++k) {
        low[k] = std::min(low[k], items[i].centre[k]);
        high[k] = std::max(high[k], items[i].centre[k]);
      }
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k)
      if (high[k] - low[k] > high[longest] - low[longest]) longest = k;
    return longest;
  }

  RawArray<Box> boxes_;
  RawArray<std::uint32_t> numbers_;
  unsigned levels_ = 0;
  RawArray<Box> nodes_;
  RawArray<std::uint32_t> first_;  // position of the first box of each leaf, and the number of boxes
};

// Sum of the costs of all threads.
class Total {
 public:
  explicit Total(std::uint64_t most) : most_(most) {}
  void add(std::uint64_t cost) { total_ += cost; }
  bool isOver() const { return total_.load(std::memory_order_relaxed) > most_; }

 private:
  std::uint64_t most_;
  std::atomic<std::uint64_t> total_{0};
};

// Visits the pairs of a leaf of one tree and those of another, from `from` on, that overlap it.
template <class Take>
void joinLeaf(const BoxTree& a, std::size_t leaf, const BoxTree& b, std::size_t from, Total& total, Take take) {
  std::uint64_t added = 0;
  bool isOver = total.isOver();
  b.forLeaves(a.leafBox(leaf), from, [&](std::size_t other) {
    for (std::uint32_t i = a.leafFirst(leaf); i < a.leafEnd(leaf) && !isOver; ++i) {
      if (!overlap(a.box(i), b.leafBox(other))) continue;
      for (std::uint32_t j = b.leafFirst(other); j < b.leafEnd(other); ++j)
        if (overlap(a.box(i), b.box(j))) added += take(i, j);
      if (added < kBatch) continue;
      total.add(std::exchange(added, 0));
      isOver = total.isOver();
    }
  });
  total.add(added);
}

}  // namespace

bool forOverlappingBoxes(std::span<const Box> a, std::span<const Box> b, std::uint64_t most, const Visit& visit) {
  const BoxTree treeOfA(a), treeOfB(b);
  Total total(most);
  tbb::parallel_for(std::size_t{0}, treeOfA.leafCount(), [&](std::size_t leaf) {
    joinLeaf(treeOfA, leaf, treeOfB, 0, total,
             [&](std::uint32_t i, std::uint32_t j) { return visit(treeOfA.number(i), treeOfB.number(j)); });
  });
  return !total.isOver();
}

bool forOverlappingPairs(std::span<const Box> boxes, std::uint64_t most, const Visit& visit) {
  const BoxTree tree(boxes);
  Total total(most);
  tbb::parallel_for(std::size_t{0}, tree.leafCount(), [&](std::size_t leaf) {
    joinLeaf(tree, leaf, tree, leaf, total, [&](std::uint32_t i, std::uint32_t j) -> std::uint32_t {
      if (j <= i) return 0;
      const std::uint32_t a = tree.number(i), b = tree.number(j);
      return visit(std::max(a, b), std::min(a, b));
    });
  });
  return !total.isOver();
}

}  // namespace malus::prep
