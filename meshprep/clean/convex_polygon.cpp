#include "meshprep/clean/convex_polygon.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr double kStraight = 1e-9;  // largest sine of the turn at a collinear corner
constexpr int kMaxTries = 8;        // fans whose end triangles have area

// Returns the first corner around which all triangles of a fan have area. The end triangles are tested first: they have
// none if the corner ends a side with collinear corners.
std::optional<std::size_t> fanCorner(const FlatPolygon& flat) {
  const std::size_t n = flat.points.size();
  const auto hasTriangle = [&](std::size_t start, std::size_t i) {
    return hasArea(flat, start, (start + i) % n, (start + i + 1) % n);
  };
  int tries = 0;
  for (std::size_t start = 0; start < n && tries < kMaxTries; ++start) {
    if (!hasTriangle(start, 1) || !hasTriangle(start, n - 2)) continue;
    ++tries;
    bool good = true;
    for (std::size_t i = 2; good && i + 2 < n; ++i) good = hasTriangle(start, i);
    if (good) return start;
  }
  return std::nullopt;
}

// Remaining boundary.
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

  std::size_t countTurning() const {
    return static_cast<std::size_t>(std::count(straight_.begin(), straight_.end(), false));
  }

  // Clips the collinear corners of the side that ends at `end`, by triangles with the corner after it.
  void cutSide(std::uint32_t end, std::vector<glm::uvec3>& triangles) {
    const std::uint32_t apex = next_[end];
    if (straight_[end] || !straight_[prev_[end]]) return;
    straight_[apex] = false;
    while (straight_[prev_[end]]) {
      const std::uint32_t before = prev_[end];
      triangles.emplace_back(before, end, apex);
      next_[before] = apex;
      prev_[apex] = before;
      next_[end] = end;  // removed from the boundary
      straight_[before] = false;
      end = before;
    }
  }

  // Appends a fan of the remaining boundary.
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
  const auto edge = [&](std::size_t i) { return flat.points[(i + 1) % n] - flat.points[i % n]; };
  bool isQuad = n == 4;  // of four left turns, which are one turn together
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = edge(i), b = edge(i + 1);
    const double cross = cross2(a, b), error = rounding(flat, a, b);
    if (cross < -error) return false;
    isQuad = isQuad && cross > error;
  }
  if (isQuad) return true;
  double turn = 0;
  for (std::size_t i = 0; i < n; ++i) turn += std::atan2(cross2(edge(i), edge(i + 1)), glm::dot(edge(i), edge(i + 1)));
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
  if (ring.countTurning() < 3) return false;
  for (std::uint32_t i = 0; i < n; ++i) ring.cutSide(i, triangles);
  ring.fan(triangles);
  return true;
}

}  // namespace malus::prep
