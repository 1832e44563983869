#include "bake/effects/deepest_bounce.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include <glm/geometric.hpp>

#include "bake/effects/mutual_visibility.h"
#include "bake/pack/instances.h"
#include "shaders/optics/optics.h"

namespace malus::bake {
using pack::Material;

namespace {

struct Face {
  std::array<glm::dvec3, 3> corners;
  glm::dvec3 normal;         // 0: without area
  const Material* material;  // nullptr: reflectance 1
};

// Largest reflectance at a cosine of incidence, over polarizations and colours.
double reflectance(const Material& m, double c) {
  double most = 0;
  for (int colour = 0; colour < 3; ++colour) {
    const f64::Reflectance r = pack::isConductor(m.kind)
                                   ? f64::conductorReflectance(c, m.outsideEta, m.eta[colour], m.k[colour])
                                   : f64::dielectricReflectance(c, m.outsideEta, m.eta.y);
    most = std::max({most, r.rs, r.rp});
  }
  return most;
}

// Largest reflectance of a face toward any of the points. The level sets of the cosine are cones, so its minimum over
// two convex sets is at corners; it is 0 if points are on both sides. A face is not visible from points at most `flat`
// from its plane. The reflectance is sampled from the minimum to normal incidence, because that of a metal is not
// monotonic.
double largestReflectance(const Face& face, std::span<const glm::dvec3> points, double flat) {
  if (!face.material || face.normal == glm::dvec3(0.0)) return 1;
  double least = 1;
  double before = 0, behind = 0;
  for (const glm::dvec3& p : points)
    for (const glm::dvec3& q : face.corners) {
      const double length = glm::length(p - q), height = glm::dot(p - q, face.normal);
      before = std::max(before, height);
      behind = std::max(behind, -height);
      least = std::min(least, length > 0 ? std::abs(height) / length : 0);
    }
  // Coplanar faces are not visible from each other.
  if (std::max(before, behind) <= flat) return 0;
  if (before > 0 && behind > 0) least = 0;
  constexpr int kSteps = 32;
  double result = 0;
  for (int i = 0; i <= kSteps; ++i)
    result = std::max(result, reflectance(*face.material, least + (1 - least) * i / kSteps));
  return result;
}

bool isFlatMirror(const Material& m, const pack::Mesh& mesh) {
  // From the denser side light can be totally reflected.
  const bool denser = pack::isDielectric(m.kind) && m.outsideEta > m.eta.y;
  return pack::isOpaqueInterface(m.kind) && !denser && mesh.normals.empty() && m.coating.thicknessNm == 0 &&
         m.clearCoat.factor == 0 && m.roughness == 0 && m.maps.eta < 0 && !m.meshMaps.any();
}

}  // namespace

std::uint32_t deepestBounce(const pack::Scene& scene, std::uint32_t depth, double tolerance) {
  std::vector<Face> faces;
  for (const pack::Placement& placement : pack::placements(scene)) {
    const pack::Mesh& mesh = *placement.mesh;
    const Material& m = scene.materials[mesh.material];
    if (!pack::isInterface(m.kind)) continue;
    for (const glm::uvec3& t : mesh.triangles) {
      if (faces.size() == kMostFaces) return depth;
      const glm::dvec3 p0 = placement.point(t.x), p1 = placement.point(t.y), p2 = placement.point(t.z);
      const glm::dvec3 across = glm::cross(p1 - p0, p2 - p0);
      const double length = glm::length(across);
      faces.push_back(
          {{p0, p1, p2}, length > 0 ? across / length : glm::dvec3(0.0), isFlatMirror(m, mesh) ? &m : nullptr});
    }
  }
  if (faces.empty()) return 0;
  const double flat = flatness(scene);
  if (!interfacesMutuallyVisible(scene)) depth = std::min(depth, 1u);

  // Step 1: from the camera. Step 2: for each bounce, the largest product of reflectances to each face.
  const std::size_t count = faces.size();
  std::vector<double> share(count);
  for (std::size_t j = 0; j < count; ++j)
    share[j] = scene.camera.isOrthographic() ? 1 : largestReflectance(faces[j], std::array{scene.camera.position}, 0);
  std::vector<double> between;
  for (std::uint32_t bounce = 1; bounce <= depth; ++bounce) {
    if (*std::max_element(share.begin(), share.end()) <= tolerance) return bounce - 1;
    if (bounce == depth) break;
    if (between.empty()) {
      between.resize(count * count);
      for (std::size_t i = 0; i < count; ++i)
        for (std::size_t j = 0; j < count; ++j)
          // A flat face is not visible from itself.
          between[i * count + j] =
              i == j && faces[i].material ? 0 : largestReflectance(faces[j], faces[i].corners, flat);
    }
    std::vector<double> next(count, 0);
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < count; ++j) next[j] = std::max(next[j], share[i] * between[i * count + j]);
    share = std::move(next);
  }
  return depth;
}

}  // namespace malus::bake
