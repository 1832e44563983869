#include "bake/pack/scene.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace malus::pack {

SpotFalloff spotFalloff(const LightSource& light) {
  if (light.kind != LightKind::spot) return {};
  // Cosines that are nearer to each other than floats resolve widen the outer cone, so that the axis keeps its
  // intensity.
  constexpr double kLeastDifference = 1e-5;
  const double inner = std::cos(light.innerConeDegrees * std::numbers::pi / 180),
               outer = std::cos(light.outerConeDegrees * std::numbers::pi / 180),
               scale = 1 / std::max(kLeastDifference, inner - outer);
  return {scale, 1 - inner * scale};
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
