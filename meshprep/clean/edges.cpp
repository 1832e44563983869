#include "meshprep/clean/edges.h"

#include <algorithm>
#include <tuple>

#include "meshprep/base/bucket_sort.h"

namespace malus::prep {

std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> triangles) {
  std::uint32_t highest = 0;
  for (const glm::uvec3& t : triangles) highest = std::max({highest, t.x, t.y, t.z});
  const auto forEach = [&](auto visit) {
    for (std::uint32_t i = 0; i < triangles.size(); ++i)
      for (int corner = 0; corner < 3; ++corner) {
        const std::uint32_t from = triangles[i][corner], to = triangles[i][(corner + 1) % 3];
        const std::uint32_t low = std::min(from, to);
        visit(low, EdgeUse{low, std::max(from, to), i, static_cast<std::uint8_t>(corner), from < to});
      }
  };
  return sortInBuckets<EdgeUse>(highest + std::size_t{1}, forEach,
                                [](const EdgeUse& a, const EdgeUse& b) {
                                  return std::tie(a.high, a.triangle) < std::tie(b.high, b.triangle);
                                })
      .items;
}

}  // namespace malus::prep
