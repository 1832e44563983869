#include "meshprep/clean/edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace malus::prep {

std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> triangles) {
  // Count the uses of each lower vertex. Sorting all of them at once is several times slower on grids.
  std::vector<std::uint32_t> end;
  for (const glm::uvec3& t : triangles)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t low = std::min(t[corner], t[(corner + 1) % 3]);
      if (low >= end.size()) end.resize(low + std::size_t{1}, 0);
      ++end[low];
    }
  std::exclusive_scan(end.begin(), end.end(), end.begin(), 0u);

  // Distribute them, and sort those of each vertex.
  std::vector<EdgeUse> uses(3 * triangles.size());
  for (std::uint32_t i = 0; i < triangles.size(); ++i)
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangles[i][corner], to = triangles[i][(corner + 1) % 3];
      const std::uint32_t low = std::min(from, to);
      uses[end[low]++] = {low, std::max(from, to), i, static_cast<std::uint8_t>(corner), from < to};
    }
  auto begin = uses.begin();
  for (const std::uint32_t e : end) {
    const auto last = uses.begin() + e;
    std::sort(begin, last, [](const EdgeUse& a, const EdgeUse& b) {
      return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
    });
    begin = last;
  }
  return uses;
}

}  // namespace malus::prep
