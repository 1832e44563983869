#include "meshprep/normals/smoothing_normals.h"

namespace malus::prep {

NormalCounts addSmoothingNormals(Mesh& mesh) {
  return addPieceNormals(mesh, [&](std::uint32_t a, std::uint32_t b, const glm::dvec3&, const glm::dvec3&) {
    return mesh.smoothingGroups[a] != 0 && mesh.smoothingGroups[a] == mesh.smoothingGroups[b];
  });
}

}  // namespace malus::prep
