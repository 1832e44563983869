#include "meshprep/clean/ears.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numeric>

#include <glm/common.hpp>

namespace malus::prep {

namespace {

constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();
constexpr std::uint64_t kNotQueued = std::numeric_limits<std::uint64_t>::max();
constexpr std::size_t kSmall = 64;  // largest polygon without grid and rounds
constexpr std::uint32_t kMaxColumns = 1024;
// Costs of a cell and of a heap operation, in tests: both wait for memory.
constexpr std::uint64_t kTestsPerCell = 5;
constexpr std::uint64_t kTestsPerCorner = 50;

}  // namespace

void EarCutter::makeRing() {
  const auto n = static_cast<std::uint32_t>(flat_->points.size());
  next_.resize(n);
  prev_.resize(n);
  for (std::uint32_t i = 0; i < n; ++i) {
    next_[i] = (i + 1) % n;
    prev_[i] = (i + n - 1) % n;
  }
  heap_.resize(n);
  std::iota(heap_.begin(), heap_.end(), std::uint64_t{0});  // a sorted list is a heap
  key_ = heap_;
  round_ = 0;
  firstWaiting_.assign(n, kNone);
  nextWaiting_.assign(n, kNone);
  prevWaiting_.assign(n, kNone);
  waitsFor_.assign(n, kNone);
}

std::uint32_t EarCutter::column(double x) const {
  return std::min(static_cast<std::uint32_t>((x - origin_.x) * cellsPerUnit_.x), columns_ - 1);
}

std::uint32_t EarCutter::row(double y) const {
  return std::min(static_cast<std::uint32_t>((y - origin_.y) * cellsPerUnit_.y), columns_ - 1);
}

// Makes a grid with a few corners per cell if they are distributed evenly.
void EarCutter::makeGrid() {
  const std::vector<glm::dvec2>& points = flat_->points;
  const std::size_t n = points.size();
  glm::dvec2 low = points.front(), high = points.front();
  for (const glm::dvec2& p : points) {
    low = glm::min(low, p);
    high = glm::max(high, p);
  }
  columns_ = n <= kSmall ? 1 : std::min(static_cast<std::uint32_t>(std::sqrt(static_cast<double>(n)) / 2), kMaxColumns);
  origin_ = low;
  cellsPerUnit_ = glm::dvec2(0);
  for (int axis = 0; axis < 2; ++axis)
    if (const double cells = columns_ / (high[axis] - low[axis]); std::isfinite(cells)) cellsPerUnit_[axis] = cells;

  // Sort by cell (counting sort).
  cell_.resize(n);
  slot_.resize(n);
  members_.resize(n);
  count_.assign(std::size_t{columns_} * columns_, 0);
  for (std::size_t i = 0; i < n; ++i) {
    cell_[i] = row(points[i].y) * columns_ + column(points[i].x);
    ++count_[cell_[i]];
  }
  begin_.resize(count_.size());
  std::exclusive_scan(count_.begin(), count_.end(), begin_.begin(), 0u);
  std::fill(count_.begin(), count_.end(), 0u);
  for (std::uint32_t i = 0; i < n; ++i) {
    slot_[i] = begin_[cell_[i]] + count_[cell_[i]]++;
    members_[slot_[i]] = i;
  }
}

void EarCutter::wait(std::uint32_t corner, std::uint32_t until) {
  waitsFor_[corner] = until;
  prevWaiting_[corner] = kNone;
  nextWaiting_[corner] = firstWaiting_[until];
  if (firstWaiting_[until] != kNone) prevWaiting_[firstWaiting_[until]] = corner;
  firstWaiting_[until] = corner;
}

void EarCutter::stopWaiting(std::uint32_t corner) {
  if (waitsFor_[corner] == kNone) return;
  const std::uint32_t before = prevWaiting_[corner], after = nextWaiting_[corner];
  (before == kNone ? firstWaiting_[waitsFor_[corner]] : nextWaiting_[before]) = after;
  if (after != kNone) prevWaiting_[after] = before;
  waitsFor_[corner] = kNone;
}

void EarCutter::enqueue(std::uint32_t corner) {
  stopWaiting(corner);
  const std::uint64_t round = flat_->points.size() <= kSmall ? 0 : round_ + 1;
  const std::uint64_t key = round << 32u | corner;
  if (key_[corner] == key) return;
  key_[corner] = key;
  heap_.push_back(key);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>());
}

// Removes a corner from boundary and grid, and enqueues the corners whose result may change.
void EarCutter::remove(std::uint32_t corner) {
  const std::uint32_t before = prev_[corner], after = next_[corner];
  next_[before] = after;
  prev_[after] = before;
  const std::uint32_t cell = cell_[corner];
  const std::uint32_t last = members_[begin_[cell] + --count_[cell]];
  members_[slot_[corner]] = last;
  slot_[last] = slot_[corner];

  next_[corner] = corner;  // removed from the boundary
  while (firstWaiting_[corner] != kNone) enqueue(firstWaiting_[corner]);
  enqueue(before);
  enqueue(after);
}

// Returns a corner inside the triangle or on its boundary, but not at the position of one of its corners.
std::optional<std::uint32_t> EarCutter::cornerInside(std::uint32_t a, std::uint32_t b, std::uint32_t c,
                                                     std::uint64_t& tests) const {
  const std::vector<glm::dvec2>& points = flat_->points;
  const glm::dvec2 low = glm::min(glm::min(points[a], points[b]), points[c]);
  const glm::dvec2 high = glm::max(glm::max(points[a], points[b]), points[c]);
  const std::uint32_t endColumn = column(high.x), endRow = row(high.y);
  for (std::uint32_t y = row(low.y); y <= endRow; ++y)
    for (std::uint32_t x = column(low.x); x <= endColumn; ++x) {
      const std::uint32_t cell = y * columns_ + x;
      const std::uint64_t cost = std::uint64_t{count_[cell]} + kTestsPerCell;
      if (cost > tests) {
        tests = 0;
        return std::nullopt;
      }
      tests -= cost;
      for (std::uint32_t k = begin_[cell]; k < begin_[cell] + count_[cell]; ++k) {
        const std::uint32_t p = members_[k];
        if (area2(*flat_, a, b, p) < 0 || area2(*flat_, b, c, p) < 0 || area2(*flat_, c, a, p) < 0) continue;
        if (points[p] != points[a] && points[p] != points[b] && points[p] != points[c]) return p;
      }
    }
  return std::nullopt;
}

EarCutter::Outcome EarCutter::cut(const FlatPolygon& flat, std::uint64_t& tests, std::vector<glm::uvec3>& triangles) {
  flat_ = &flat;
  makeRing();
  makeGrid();
  const std::size_t before = triangles.size();
  const std::size_t wanted = flat.points.size() - 2;
  const auto undo = [&](Outcome outcome) {
    triangles.resize(before);
    return outcome;
  };
  while (triangles.size() - before < wanted) {
    if (heap_.empty()) return undo(Outcome::kNoEars);
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>());
    const std::uint64_t key = heap_.back();
    heap_.pop_back();
    const auto b = static_cast<std::uint32_t>(key);
    if (key_[b] != key || next_[b] == b) continue;  // enqueued again, or removed
    key_[b] = kNotQueued;
    round_ = key >> 32u;
    tests -= std::min(tests, kTestsPerCorner);
    const std::uint32_t a = prev_[b], c = next_[b];
    if (!hasArea(flat, a, b, c)) continue;  // until a neighbour is removed

    const std::optional<std::uint32_t> inside = cornerInside(a, b, c, tests);
    if (tests == 0) return undo(Outcome::kTooMuchWork);
    if (inside) {
      wait(b, *inside);
      continue;
    }
    triangles.emplace_back(a, b, c);
    remove(b);
  }
  return Outcome::kDone;
}

}  // namespace malus::prep
