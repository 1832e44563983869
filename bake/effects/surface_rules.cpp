#include "bake/effects/rules.h"

namespace malus::bake {
using pack::Material;
using pack::MaterialKind;
using shaders::Effect;

namespace {

// Leaves the diffuse surface below the interface, which is black without an albedo.
void removeInterface(Material& m) {
  m.kind = MaterialKind::lambert;
  m.eta = glm::dvec3(1.0);
  m.k = glm::dvec3(0.0);
  m.highlightStrength = 0;
  m.specularFactor = 1;
  m.clearCoat = {};
  m.transmittanceParallel = glm::dvec3(1.0);
  m.meshMaps.transmittance = {};
  m.meshMaps.eta = m.meshMaps.k = m.meshMaps.reflectance = m.meshMaps.metallic = m.meshMaps.roughness = {};
}

void removeSurface(Effect surface, Material& m) {
  if (surfaceEffect(m.kind) != surface) return;
  if (surface == Effect::kGlass) {
    m.kind = MaterialKind::mirrorGlass;
    m.transmittanceParallel = glm::dvec3(1.0);
    m.meshMaps.transmittance = {};
  } else if (pack::isClear(m.kind)) {  // not a body: invisible if its index is that of the medium
    m.eta = glm::dvec3(m.outsideEta);
    m.transmittanceParallel = m.transmittanceCrossed = glm::dvec3(1.0);
    m.meshMaps.transmittance = {};
  } else if (surface == Effect::kPolarizingElement) {  // a grey filter of the same mean transmittance
    m.transmittanceParallel = m.transmittanceCrossed = (m.transmittanceParallel + m.transmittanceCrossed) * 0.5;
    m.retardanceDegrees = glm::dvec3(0.0);
  } else {
    removeInterface(m);
  }
}

}  // namespace

std::vector<EffectRule> surfaceRules() {
  std::vector<EffectRule> rules;
  for (std::size_t i = 0; i < shaders::kCompiledEffects.size(); ++i) {
    if (!shaders::kCompiledEffects[i].isSurface) continue;
    const auto surface = static_cast<Effect>(i);
    rules.push_back(materialRule(
        surface, [surface](const Material& m) { return surfaceEffect(m.kind) == surface; },
        [surface](Material& m) { removeSurface(surface, m); }));
  }
  rules.push_back(materialRule(
      Effect::kDielectric, [](const Material& m) { return pack::isDielectric(m.kind); },
      [](Material& m) {
        if (pack::isDielectric(m.kind)) removeInterface(m);
      }));
  rules.push_back({Effect::kInstances, [](const EffectQuery& q) { return !q.scene.instances.empty(); }, {}, {}});
  return rules;
}

}  // namespace malus::bake
