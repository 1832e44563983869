// Small scenes built in code, for closed forms: quads of any material in an environment.
#pragma once

#include <cmath>
#include <string>

#include <glm/geometric.hpp>

#include "bake/environment/octahedral_map.h"
#include "bake/pack/scene.h"

namespace malus::test {

inline pack::Scene emptyScene(std::uint32_t depth) {
  pack::Scene scene;
  scene.name = "test";
  scene.width = scene.height = 1;
  scene.depth = depth;
  scene.camera.verticalFovDegrees = 0.01;  // one ray, straight ahead
  return scene;
}

inline void look(pack::Scene& scene, const glm::dvec3& from, const glm::dvec3& to, const glm::dvec3& up = {0, 1, 0}) {
  pack::Camera& c = scene.camera;
  c.position = from;
  c.forward = glm::normalize(to - from);
  c.right = glm::normalize(glm::cross(c.forward, up));
  c.up = glm::cross(c.right, c.forward);
}

inline std::uint32_t addMaterial(pack::Scene& scene, pack::Material material) {
  scene.materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(scene.materials.size() - 1);
}

inline pack::Material dielectric(pack::MaterialKind kind, double eta, double albedo = 0) {
  pack::Material m;
  m.name = "dielectric";
  m.kind = kind;
  m.eta = glm::dvec3(eta);
  m.albedo = glm::dvec3(albedo);
  return m;
}

inline pack::Material metal(const glm::dvec3& eta, const glm::dvec3& k) {
  pack::Material m;
  m.name = "metal";
  m.kind = pack::MaterialKind::metal;
  m.eta = eta;
  m.k = k;
  return m;
}

inline pack::Material emitter(const glm::dvec3& radiance) {
  pack::Material m;
  m.name = "emitter";
  m.kind = pack::MaterialKind::emitter;
  m.radiance = radiance;
  return m;
}

// Square of half side `half` about a centre, facing along normal.
inline void addSquare(pack::Scene& scene, std::uint32_t material, const glm::dvec3& centre, const glm::dvec3& normal,
                      double half) {
  const glm::dvec3 n = glm::normalize(normal);
  const glm::dvec3 u = glm::normalize(glm::cross(std::abs(n.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0), n));
  const glm::dvec3 v = glm::cross(n, u);
  pack::Mesh mesh;
  mesh.name = "square " + std::to_string(scene.meshes.size());
  mesh.material = material;
  for (const auto& [a, b] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)})
    mesh.positions.emplace_back(centre + u * (a * half) + v * (b * half));
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  scene.meshes.push_back(std::move(mesh));
}

}  // namespace malus::test
