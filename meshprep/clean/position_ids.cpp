#include "meshprep/clean/position_ids.h"

#include <bit>
#include <cstddef>
#include <limits>

namespace malus::prep {

namespace {

// Hash of the coordinates; positive and negative zero are equal.
std::size_t hashPosition(const glm::dvec3& p) {
  std::uint64_t hash = 0x9e3779b97f4a7c15u;
  for (int axis = 0; axis < 3; ++axis) {
    hash ^= std::bit_cast<std::uint64_t>(p[axis] + 0.0);
    hash *= 0xff51afd7ed558ccdu;  // finalizer of MurmurHash3, A. Appleby
    hash ^= hash >> 33u;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

std::vector<std::uint32_t> positionIds(const Mesh& mesh) {
  // A table with open addressing, several times faster than std::unordered_map or sorting for millions of vertices.
  constexpr std::uint32_t kEmpty = std::numeric_limits<std::uint32_t>::max();
  const std::vector<glm::dvec3>& positions = mesh.positions;
  std::vector<std::uint32_t> table(std::bit_ceil(2 * positions.size() + 1), kEmpty), ids(positions.size());
  const std::size_t mask = table.size() - 1;
  for (std::uint32_t i = 0; i < ids.size(); ++i) {
    std::size_t slot = hashPosition(positions[i]) & mask;
    while (table[slot] != kEmpty && positions[table[slot]] != positions[i]) slot = (slot + 1) & mask;
    if (table[slot] == kEmpty) table[slot] = i;
    ids[i] = table[slot];
  }
  return ids;
}

}  // namespace malus::prep
