#include "bake/pack/scene.h"

namespace malus::pack {

std::string_view nameOf(MaterialKind kind) {
  switch (kind) {
    case MaterialKind::lambert:
      return "lambert";
    case MaterialKind::paint:
      return "paint";
    case MaterialKind::mirrorGlass:
      return "mirror-glass";
    case MaterialKind::metal:
      return "metal";
    case MaterialKind::glass:
      return "glass";
    case MaterialKind::emitter:
      return "emitter";
    case MaterialKind::polarizer:
      return "polarizer";
    case MaterialKind::wavePlate:
      return "wave-plate";
  }
  return "unknown";
}

bool Material::isPlain() const {
  return kind != MaterialKind::polarizer && kind != MaterialKind::wavePlate && absorption == glm::dvec3(0.0) &&
         outsideAbsorption == glm::dvec3(0.0) && coating.thicknessNm == 0 && roughness == 0 && polarization == 0 &&
         !maps.any();
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
