#include "meshprep/clean/unreferenced_vertices.h"

#include <vector>

namespace malus::prep {

std::uint64_t dropUnreferencedVertices(Mesh& mesh) {
  std::vector<char> used(mesh.positions.size(), 0);
  for (const glm::uvec3& t : mesh.triangles) used[t.x] = used[t.y] = used[t.z] = 1;

  std::vector<std::uint32_t> newIndex(mesh.positions.size(), 0);
  std::uint32_t kept = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    mesh.positions[kept] = mesh.positions[i];
    if (!mesh.normals.empty()) mesh.normals[kept] = mesh.normals[i];
    newIndex[i] = kept++;
  }
  const std::uint64_t dropped = mesh.positions.size() - kept;
  mesh.positions.resize(kept);
  if (!mesh.normals.empty()) mesh.normals.resize(kept);
  for (glm::uvec3& t : mesh.triangles) t = {newIndex[t.x], newIndex[t.y], newIndex[t.z]};
  return dropped;
}

}  // namespace malus::prep
