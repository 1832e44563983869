#include "meshprep/clean/box_pairs.h"

#include <atomic>
#include <utility>
#include <vector>

#include <tbb/parallel_for.h>
#include <boost/geometry.hpp>  // the index alone lacks the strategies that it uses in Boost 1.83
#include <boost/geometry/index/rtree.hpp>
#include <boost/iterator/function_output_iterator.hpp>

namespace malus::prep {

namespace {

namespace bg = boost::geometry;

using Point = bg::model::point<double, 3, bg::cs::cartesian>;
using TreeBox = bg::model::box<Point>;
using Entry = std::pair<TreeBox, std::uint32_t>;

constexpr std::uint64_t kBatch = 1024;  // cost of a box between updates of the total

TreeBox treeBox(const Box& box) { return {{box.low.x, box.low.y, box.low.z}, {box.high.x, box.high.y, box.high.z}}; }

}  // namespace

bool forOverlappingBoxes(std::span<const Box> a, std::span<const Box> b, std::uint64_t most,
                         const std::function<std::uint32_t(std::uint32_t, std::uint32_t)>& visit) {
  // Build the tree from all entries at once.
  std::vector<Entry> entries;
  entries.reserve(b.size());
  for (std::uint32_t j = 0; j < b.size(); ++j) entries.emplace_back(treeBox(b[j]), j);
  const bg::index::rtree<Entry, bg::index::quadratic<16>> tree(entries);
  entries = {};

  // Query each box, until the cost is too high.
  std::atomic<std::uint64_t> cost{0};
  tbb::parallel_for(std::size_t{0}, a.size(), [&](std::size_t i) {
    if (cost.load(std::memory_order_relaxed) > most) return;
    std::uint64_t added = 0;
    bool isOver = false;  // skips the rest, because a query cannot be stopped
    const auto take = [&](const Entry& entry) {
      if (isOver) return;
      added += visit(static_cast<std::uint32_t>(i), entry.second);
      if (added < kBatch) return;
      cost += std::exchange(added, 0);
      isOver = cost.load(std::memory_order_relaxed) > most;
    };
    tree.query(bg::index::intersects(treeBox(a[i])), boost::make_function_output_iterator(take));
    cost += added;
  });
  return cost <= most;
}

}  // namespace malus::prep
