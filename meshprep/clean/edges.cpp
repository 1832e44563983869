#include "meshprep/clean/edges.h"

#include <algorithm>
#include <tuple>

namespace malus::prep {

std::vector<EdgeUse> edgeUses(std::span<const glm::uvec3> triangles) {
  std::vector<EdgeUse> uses;
  uses.reserve(3 * triangles.size());
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    for (int corner = 0; corner < 3; ++corner) {
      const std::uint32_t from = triangles[i][corner], to = triangles[i][(corner + 1) % 3];
      uses.push_back({std::min(from, to), std::max(from, to), static_cast<std::uint32_t>(i),
                      static_cast<std::uint8_t>(corner), from < to});
    }
  }
  std::sort(uses.begin(), uses.end(), [](const EdgeUse& a, const EdgeUse& b) {
    return std::tie(a.low, a.high, a.triangle) < std::tie(b.low, b.high, b.triangle);
  });
  return uses;
}

}  // namespace malus::prep
