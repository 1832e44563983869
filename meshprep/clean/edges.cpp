#include "meshprep/clean/edges.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

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
  constexpr std::size_t kGrain = 4096;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, end.size(), kGrain), [&](const auto& range) {
    for (std::size_t low = range.begin(); low < range.end(); ++low)
      std::sort(uses.begin() + (low == 0 ? 0 : end[low - 1]), uses.begin() + end[low],
                [](const EdgeUse& a, const EdgeUse& b) {
                  return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
                });
  });
  return uses;
}

}  // namespace malus::prep
