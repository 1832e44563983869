// Scenes of one mesh per material, for the rules of the effects.
#pragma once

#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bake/effects/effects.h"

namespace malus::bake {

inline pack::Material material(pack::MaterialKind kind, double albedo = 0) {
  pack::Material m;
  m.name = std::string(pack::materialKindName(kind));
  m.kind = kind;
  if (kind == pack::MaterialKind::metal) {
    m.eta = glm::dvec3(0.2);
    m.k = glm::dvec3(3);
  } else if (kind != pack::MaterialKind::lambert && kind != pack::MaterialKind::emitter) {
    m.eta = glm::dvec3(1.5);
  }
  m.albedo = glm::dvec3(albedo);
  if (kind == pack::MaterialKind::emitter) m.radiance = glm::dvec3(1);
  return m;
}

// A scene with one mesh per material.
inline pack::Scene makeScene(std::vector<pack::Material> materials, std::uint32_t depth) {
  pack::Scene scene;
  scene.depth = depth;
  scene.materials = std::move(materials);
  for (std::uint32_t i = 0; i < scene.materials.size(); ++i) {
    pack::Mesh mesh;
    mesh.material = i;
    scene.meshes.push_back(mesh);
  }
  return scene;
}

inline std::map<std::string, bool> effectStates(const pack::Scene& scene) {
  std::map<std::string, bool> on;
  for (const pack::Effect& e : findEffects(scene)) {
    EXPECT_FALSE(e.reason.empty()) << e.name;
    on[e.name] = e.on;
  }
  return on;
}

}  // namespace malus::bake
