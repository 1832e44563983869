#include "bake/effects/light_visibility.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/effects/mutual_visibility.h"
#include "bake/effects/query.h"
#include "bake/pack/instances.h"

namespace malus::bake {

namespace {

constexpr std::size_t kMostTests = 1'000'000;

struct Face {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal;
  bool isTwoSided;
};

// Whether a point of `points` is in front of the face, or off its plane if it is two-sided.
bool faces(const Face& face, std::span<const glm::dvec3> points, double flat) {
  return std::ranges::any_of(points, [&](const glm::dvec3& p) {
    const double height = glm::dot(p - face.corners[0], face.normal);
    return (face.isTwoSided ? std::abs(height) : height) > flat;
  });
}

}  // namespace

bool emittersSeeDiffuseSurfaces(const pack::Scene& scene) {
  std::vector<Face> emitters, diffuse;
  for (const pack::Placement& placement : pack::placements(scene)) {
    const pack::Material& m = scene.materials[placement.mesh->material];
    const bool emits = isAreaLight(m);
    if (!emits && !isDiffuseMaterial(m)) continue;
    for (const glm::uvec3& t : placement.mesh->triangles) {
      Face face{{placement.point(t.x), placement.point(t.y), placement.point(t.z)}, {}, !emits || m.twoSided};
      const glm::dvec3 n = glm::cross(face.corners[1] - face.corners[0], face.corners[2] - face.corners[0]);
      if (!(glm::length(n) > 0)) continue;
      face.normal = glm::normalize(placement.isMirrored() ? -n : n);
      (emits ? emitters : diffuse).push_back(face);
    }
  }
  if (emitters.size() * diffuse.size() > kMostTests) return true;
  const double flat = flatness(scene);
  return std::ranges::any_of(emitters, [&](const Face& emitter) {
    return std::ranges::any_of(diffuse, [&](const Face& surface) {
      return faces(emitter, surface.corners, flat) && faces(surface, emitter.corners, flat);
    });
  });
}

}  // namespace malus::bake
