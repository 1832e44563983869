#include "meshprep/clean/unreferenced_vertices.h"

#include <vector>

#include "meshprep/clean/select.h"

namespace malus::prep {

Findings dropUnreferencedVertices(Mesh& mesh) {
  std::vector<char> used(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = 1;

  Findings dropped;
  std::vector<std::uint32_t> kept, newIndex(mesh.positions.size(), 0);
  for (std::uint32_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) {
      dropped.add([&] { return findingAt(mesh, mesh.positions[i], {}, {i}); });
      continue;
    }
    newIndex[i] = static_cast<std::uint32_t>(kept.size());
    kept.push_back(i);
  }
  if (dropped.count > 0) selectVertices(mesh, kept, newIndex);
  return dropped;
}

}  // namespace malus::prep
