#include "meshprep/clean/position_ids.h"

#include <algorithm>
#include <numeric>
#include <tuple>

namespace malus::prep {

std::vector<std::uint32_t> positionIds(const Mesh& mesh) {
  std::vector<std::uint32_t> order(mesh.positions.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    const glm::dvec3 &p = mesh.positions[a], &q = mesh.positions[b];
    return std::tie(p.x, p.y, p.z, a) < std::tie(q.x, q.y, q.z, b);
  });
  std::vector<std::uint32_t> ids(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
    ids[order[i]] = i > 0 && mesh.positions[order[i]] == mesh.positions[order[i - 1]] ? ids[order[i - 1]] : order[i];
  return ids;
}

}  // namespace malus::prep
