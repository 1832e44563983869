#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "bake/effects/rules.h"

namespace malus::bake {
using pack::Material;
using shaders::Effect;

EffectRule materialRule(Effect effect, const EffectQuery::Predicate& predicate,
                        const std::function<void(Material&)>& removeFrom) {
  EffectRule rule;
  rule.effect = effect;
  rule.isOn = [predicate](const EffectQuery& q) { return q.any(predicate); };
  rule.reason = [predicate](const EffectQuery& q, bool on) {
    return on ? fmt::format("materials: {}", q.names(predicate)) : "no material has it";
  };
  if (removeFrom)
    rule.remove = [removeFrom](pack::Scene& scene) {
      for (Material& m : scene.materials) removeFrom(m);
    };
  return rule;
}

namespace {

// The same rule for an effect that needs a reflection.
EffectRule ifReflecting(EffectRule rule) {
  rule.isOn = [isOn = rule.isOn](const EffectQuery& q) { return q.reflects() && isOn(q); };
  rule.reason = [reason = rule.reason](const EffectQuery& q, bool on) {
    return q.reflects() ? reason(q, on) : "not needed at depth 0";
  };
  return rule;
}

// Total internal reflection follows from the index of refraction: it cannot be removed.
EffectRule totalReflectionRule() {
  const auto denser = [](const EffectQuery& q) {
    return [&scene = q.scene](const Material& m) { return hasDenserSide(scene, m); };
  };
  EffectRule rule;
  rule.effect = Effect::kTir;
  rule.isOn = [denser](const EffectQuery& q) { return q.reflects() && q.any(denser(q)); };
  rule.reason = [denser](const EffectQuery& q, bool on) {
    return on ? fmt::format("light can meet these from their denser side: {}; not needed at depth 0",
                            q.names(denser(q)))
              : "light meets no surface from its denser side";
  };
  return rule;
}

// The same removal; without textures where no material has a map any more.
std::function<void(pack::Scene&)> withoutUnusedTextures(std::function<void(pack::Scene&)> remove) {
  return [remove = std::move(remove)](pack::Scene& scene) {
    remove(scene);
    const auto hasMaps = [](const Material& m) { return m.maps.any() || m.meshMaps.any(); };
    if (std::none_of(scene.materials.begin(), scene.materials.end(), hasMaps)) scene.textures.clear();
  };
}

}  // namespace

std::vector<EffectRule> materialRules() {
  const auto emits = [](const Material& m) { return !pack::isEmitter(m.kind) && isPositive(m.radiance); };
  EffectRule meshTextures = materialRule(
      Effect::kMeshTextures, [emits](const Material& m) { return m.meshMaps.any() || emits(m); },
      [emits](Material& m) {
        m.meshMaps = {};
        if (emits(m)) m.radiance = glm::dvec3(0.0);
      });
  meshTextures.remove = withoutUnusedTextures(meshTextures.remove);
  EffectRule textures = materialRule(
      Effect::kTextures, [](const Material& m) { return m.maps.any(); }, [](Material& m) { m.maps = {}; });
  textures.remove = withoutUnusedTextures(textures.remove);
  EffectRule tintedGlass = materialRule(
      Effect::kTintedGlass,
      [](const Material& m) {
        return pack::hasInside(m.kind) &&
               (m.transmittanceParallel != glm::dvec3(1.0) || m.meshMaps.transmittance.isUsed());
      },
      [](Material& m) {
        if (!pack::hasInside(m.kind)) return;
        m.transmittanceParallel = glm::dvec3(1.0);
        m.meshMaps.transmittance = {};
      });
  tintedGlass.remove = withoutUnusedTextures(tintedGlass.remove);
  return {
      textures,
      meshTextures,
      materialRule(
          Effect::kNormalMaps, [](const Material& m) { return m.meshMaps.normal.isUsed(); },
          [](Material& m) { m.meshMaps.normal = {}; }),
      materialRule(
          Effect::kCutOuts, [](const Material& m) { return m.meshMaps.coverage.isUsed(); },
          [](Material& m) { m.meshMaps.coverage = {}; }),
      materialRule(
          Effect::kAbsorption,
          [](const Material& m) { return isPositive(m.absorption) || isPositive(m.outsideAbsorption); },
          [](Material& m) { m.absorption = m.outsideAbsorption = glm::dvec3(0.0); }),
      materialRule(Effect::kCoatings, isCoated, [](Material& m) { m.coating = {}; }),
      materialRule(
          Effect::kSpecularFactors, [](const Material& m) { return m.specularFactor < 1; },
          [](Material& m) { m.specularFactor = 1; }),
      tintedGlass,
      materialRule(Effect::kClearCoats, hasClearCoat, [](Material& m) { m.clearCoat = {}; }),
      ifReflecting(materialRule(
          Effect::kRoughness, [](const Material& m) { return m.roughness > 0 || m.meshMaps.roughness.isUsed(); },
          [](Material& m) {
            m.roughness = 0;
            m.meshMaps.roughness = {};
          })),
      materialRule(Effect::kPolarizedEmitters, isPolarizedEmitter,
                   [](Material& m) {
                     if (pack::isEmitter(m.kind)) m.polarization = 0;
                   }),
      materialRule(Effect::kDiffuse, isDiffuseMaterial,
                   [](Material& m) {
                     m.albedo = glm::dvec3(0.0);
                     m.meshMaps.albedo = {};
                   }),
      materialRule(
          Effect::kEmitters, [](const Material& m) { return pack::isEmitter(m.kind) && isPositive(m.radiance); },
          [](Material& m) { m.radiance = glm::dvec3(0.0); }),
      totalReflectionRule(),
  };
}

}  // namespace malus::bake
