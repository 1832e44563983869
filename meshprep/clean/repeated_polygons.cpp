#include "meshprep/clean/repeated_polygons.h"

#include <algorithm>
#include <bit>

namespace malus::prep {

namespace {

// Mixes the bits of a number (finalizer of MurmurHash3, A. Appleby, public domain).
std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ h >> 33u) * 0xff51afd7ed558ccdu;
  h = (h ^ h >> 33u) * 0xc4ceb9fe1a85ec53u;
  return h ^ h >> 33u;
}

// Does not depend on the order of the corners. Adding 0 makes zeros of both signs equal.
std::uint64_t hashCorners(std::span<const glm::dvec3> positions) {
  std::uint64_t sum = positions.size();
  for (const glm::dvec3& p : positions) {
    std::uint64_t h = 0;
    for (int i = 0; i < 3; ++i) h = mixed(h + std::bit_cast<std::uint64_t>(p[i] + 0.0));
    sum += h;
  }
  return sum;
}

// Returns for each corner of `a` the corner of `b` at the same position, if the cyclic orders are equal, or opposite
// with `reversed`, and no position occurs twice in `b`.
std::optional<std::vector<std::uint32_t>> matchCorners(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b,
                                                       bool reversed) {
  const std::size_t n = a.size();
  const auto start = static_cast<std::size_t>(std::find(b.begin(), b.end(), a[0]) - b.begin());
  if (b.size() != n || start == n) return std::nullopt;
  std::vector<std::uint32_t> corners(n);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t j = reversed ? (start + n - i) % n : (start + i) % n;
    if (a[i] != b[j]) return std::nullopt;
    corners[i] = static_cast<std::uint32_t>(j);
  }
  return corners;
}

bool hasRepetition(std::span<const glm::dvec3> positions) {
  std::vector<glm::dvec3> sorted(positions.begin(), positions.end());
  std::sort(sorted.begin(), sorted.end(), [](const glm::dvec3& a, const glm::dvec3& b) {
    return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
  });
  return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

}  // namespace

std::optional<RepeatedPolygons::Match> RepeatedPolygons::add(std::span<const glm::dvec3> positions) {
  const std::size_t number = first_.size() - 1;
  positions_.insert(positions_.end(), positions.begin(), positions.end());
  first_.push_back(positions_.size());
  const std::uint64_t hash = hashCorners(positions);
  const auto [begin, end] = byHash_.equal_range(hash);
  std::optional<Match> match;
  for (auto candidate = begin; candidate != end; ++candidate) {
    if (match && match->polygon < candidate->second) continue;
    for (const bool reversed : {false, true})
      if (auto corners = matchCorners(polygon(candidate->second), positions, reversed); corners)
        match = Match{candidate->second, std::move(*corners), reversed};
  }
  if (match && hasRepetition(positions)) return std::nullopt;
  if (!match) byHash_.emplace(hash, number);
  return match;
}

}  // namespace malus::prep
