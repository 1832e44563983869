#include "meshprep/clean/repeated_polygons.h"

#include <algorithm>
#include <bit>
#include <utility>

namespace malus::prep {

namespace {

constexpr std::uint32_t kEmpty = 0xffffffffu;

// Mixes the bits of a number (finalizer of MurmurHash3, A. Appleby, public domain).
std::uint64_t mixed(std::uint64_t h) {
  h = (h ^ h >> 33u) * 0xff51afd7ed558ccdu;
  h = (h ^ h >> 33u) * 0xc4ceb9fe1a85ec53u;
  return h ^ h >> 33u;
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

RepeatedHashes::RepeatedHashes(std::size_t size) {
  constexpr std::size_t kSlots = 8;  // per hash: few share one
  counts_.resize(std::bit_ceil(kSlots * size + 1), 0);
}

void RepeatedHashes::add(std::uint64_t hash) {
  std::uint8_t& count = counts_[hash & (counts_.size() - 1)];
  count = std::min<std::uint8_t>(count + 1u, 2);
}

void RepeatedPolygons::grow() {
  const std::vector<std::uint32_t> before =
      std::exchange(table_, std::vector<std::uint32_t>(std::max(std::size_t{64}, 2 * table_.size()), kEmpty));
  used_ = 0;
  for (const std::uint32_t number : before)
    if (number != kEmpty) insert(number);
}

void RepeatedPolygons::insert(std::size_t number) {
  if (2 * (used_ + 1) > table_.size()) grow();
  std::size_t slot = hashes_[number];
  while (table_[slot & (table_.size() - 1)] != kEmpty) ++slot;
  table_[slot & (table_.size() - 1)] = static_cast<std::uint32_t>(number);
  ++used_;
}

std::optional<RepeatedPolygons::Match> RepeatedPolygons::add(std::span<const glm::dvec3> positions) {
  const std::size_t number = hashes_.size();
  const std::uint64_t hash = hashCorners(positions);
  positions_.insert(positions_.end(), positions.begin(), positions.end());
  first_.push_back(positions_.size());
  hashes_.push_back(hash);
  std::optional<Match> match;
  for (std::size_t slot = hash; !table_.empty() && table_[slot & (table_.size() - 1)] != kEmpty; ++slot) {
    const std::size_t candidate = table_[slot & (table_.size() - 1)];
    if (hashes_[candidate] != hash || (match && match->polygon < candidate)) continue;
    for (const bool reversed : {false, true})
      if (auto corners = matchCorners(polygon(candidate), positions, reversed); corners)
        match = Match{candidate, std::move(*corners), reversed};
  }
  if (match && hasRepetition(positions)) return std::nullopt;
  if (!match) insert(number);
  return match;
}

}  // namespace malus::prep
