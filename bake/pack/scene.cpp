#include "bake/pack/scene.h"

namespace malus::pack {

std::uint64_t Scene::vertexCount() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.positions.size();
  return count;
}

std::uint64_t Scene::triangleCount() const {
  std::uint64_t count = 0;
  for (const Mesh& mesh : meshes) count += mesh.triangles.size();
  return count;
}

}  // namespace malus::pack
