#include "meshprep/clean/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr double kStraight = 1e-9;  // sine of the turn at a corner within a side
constexpr int kMaxTries = 8;        // of fans that look good at both ends

// The first corner around which every triangle of a fan has area. Those at the ends have none where the corner ends a
// side with corners in it: only where they are fine are the others worth a look.
std::optional<std::size_t> fanCorner(const FlatPolygon& flat) {
  const std::size_t n = flat.points.size();
  const auto fine = [&](std::size_t start, std::size_t i) {
    return hasArea(flat, start, (start + i) % n, (start + i + 1) % n);
  };
  int tries = 0;
  for (std::size_t start = 0; start < n && tries < kMaxTries; ++start) {
    if (!fine(start, 1) || !fine(start, n - 2)) continue;
    ++tries;
    bool good = true;
    for (std::size_t i = 2; good && i + 2 < n; ++i) good = fine(start, i);
    if (good) return start;
  }
  return std::nullopt;
}

// What is left of the boundary, as a ring.
class Ring {
 public:
  explicit Ring(const FlatPolygon& flat) : next_(flat.points.size()), prev_(next_.size()), straight_(next_.size()) {
    const auto n = static_cast<std::uint32_t>(next_.size());
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = (i + 1) % n;
      prev_[i] = (i + n - 1) % n;
      const glm::dvec2 a = flat.points[i] - flat.points[prev_[i]];
      const glm::dvec2 b = flat.points[next_[i]] - flat.points[i];
      straight_[i] = cross2(a, b) <= kStraight * glm::length(a) * glm::length(b);
    }
  }

  std::size_t turning() const {
    return static_cast<std::size_t>(std::count(straight_.begin(), straight_.end(), false));
  }

  // Cuts off a side that ends at `end`: all its corners together with the corner after it. Of the side, its beginning
  // and the corner after that are left, and every corner touched turns.
  void cutSide(std::uint32_t end, std::vector<glm::uvec3>& triangles) {
    const std::uint32_t apex = next_[end];
    if (straight_[end] || !straight_[prev_[end]]) return;
    straight_[apex] = false;
    while (straight_[prev_[end]]) {
      const std::uint32_t before = prev_[end];
      triangles.emplace_back(before, end, apex);
      next_[before] = apex;
      prev_[apex] = before;
      next_[end] = end;  // no longer of the ring
      straight_[before] = false;
      end = before;
    }
  }

  // A fan of what is left.
  void fan(std::vector<glm::uvec3>& triangles) const {
    std::uint32_t first = 0;
    while (next_[first] == first) ++first;
    for (std::uint32_t i = next_[first]; next_[i] != first; i = next_[i]) triangles.emplace_back(first, i, next_[i]);
  }

 private:
  std::vector<std::uint32_t> next_, prev_;
  std::vector<bool> straight_;
};

}  // namespace

bool isConvex(const FlatPolygon& flat) {
  const std::size_t n = flat.points.size();
  double turn = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = flat.points[(i + 1) % n] - flat.points[i];
    const glm::dvec2 b = flat.points[(i + 2) % n] - flat.points[(i + 1) % n];
    if (cross2(a, b) < -rounding(flat, a, b)) return false;
    turn += std::atan2(cross2(a, b), glm::dot(a, b));
  }
  return turn < 3 * 3.14159265358979;
}

bool addConvex(const FlatPolygon& flat, std::vector<glm::uvec3>& triangles) {
  const auto n = static_cast<std::uint32_t>(flat.points.size());
  if (const std::optional<std::size_t> start = fanCorner(flat)) {
    const auto s = static_cast<std::uint32_t>(*start);
    for (std::uint32_t i = 1; i + 1 < n; ++i) triangles.emplace_back(s, (s + i) % n, (s + i + 1) % n);
    return true;
  }
  Ring ring(flat);
  if (ring.turning() < 3) return false;
  for (std::uint32_t i = 0; i < n; ++i) ring.cutSide(i, triangles);
  ring.fan(triangles);
  return true;
}

}  // namespace malus::prep
