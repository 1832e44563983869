// Sets of corners (3 * triangle + corner), merged as it is found that they belong together.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace malus::prep {

class Pieces {
 public:
  explicit Pieces(std::size_t corners) : parent_(corners) { std::iota(parent_.begin(), parent_.end(), 0u); }

  // The smallest corner stands for the set, so results do not depend on the order of merging.
  std::uint32_t find(std::uint32_t corner) {
    while (parent_[corner] != corner) corner = parent_[corner] = parent_[parent_[corner]];
    return corner;
  }
  void merge(std::uint32_t a, std::uint32_t b) {
    a = find(a);
    b = find(b);
    if (a < b) parent_[b] = a;
    if (b < a) parent_[a] = b;
  }

 private:
  std::vector<std::uint32_t> parent_;
};

}  // namespace malus::prep
