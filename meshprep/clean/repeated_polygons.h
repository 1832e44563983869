// Polygons that are given more than once: the copies of a face, and the two sides of a doubled surface. They are cut
// along the same diagonals, whatever corner they begin with, so that their triangles are found to be duplicates, or
// back to back (duplicate_faces.h). Cut along different diagonals they would be a flat solid.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::prep {

// Returns a number that is equal for polygons with the same positions in any order.
std::uint64_t hashCorners(std::span<const glm::dvec3> positions);

// Set of the hashes that occur more than once. May report others, too.
class RepeatedHashes {
 public:
  // Adds the hash of a polygon; size: at least their number.
  explicit RepeatedHashes(std::size_t size);
  void add(std::uint64_t hash);
  bool mayContain(std::uint64_t hash) const { return counts_[hash & (counts_.size() - 1)] > 1; }

 private:
  std::vector<std::uint8_t> counts_;  // of hashes, at most 2, by their lowest bits
};

class RepeatedPolygons {
 public:
  // Earlier polygon with the same corners: its number in order of add(), and for each of its corners the number of the
  // corner at the same position.
  struct Match {
    std::size_t polygon;
    std::vector<std::uint32_t> corners;
    bool reversed;  // the order of the corners is opposite
  };

  // Adds a polygon of at least three corners. Returns the earliest one with the same positions in the same or the
  // opposite cyclic order. Polygons that visit a position twice are not compared.
  std::optional<Match> add(std::span<const glm::dvec3> positions);

 private:
  std::span<const glm::dvec3> polygon(std::size_t i) const {
    return std::span(positions_).subspan(first_[i], first_[i + 1] - first_[i]);
  }

  void grow();
  void insert(std::size_t number);

  std::vector<glm::dvec3> positions_;
  std::vector<std::size_t> first_ = {0};
  std::vector<std::uint64_t> hashes_;  // of the polygons

  // Table with open addressing of the polygons without the copies, of which several may have equal hashes. A node per
  // polygon, as std::unordered_multimap has, takes several times longer.
  std::vector<std::uint32_t> table_;
  std::size_t used_ = 0;  // slots
};

}  // namespace malus::prep
