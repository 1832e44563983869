#include "bake/pack/scene.h"

namespace malus::pack {

bool Material::isPlain() const {
  return !isPolarizingElement(kind) && absorption == glm::dvec3(0.0) && outsideAbsorption == glm::dvec3(0.0) &&
         coating.thicknessNm == 0 && roughness == 0 && polarization == 0 && !maps.any();
}

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
