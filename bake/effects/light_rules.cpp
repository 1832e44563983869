#include <algorithm>
#include <cstddef>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "bake/effects/rules.h"

namespace malus::bake {
using pack::Material;
using shaders::Effect;

namespace {

// Returns one of two constant reasons.
std::function<std::string(const EffectQuery&, bool)> either(const char* on, const char* off) {
  return [on, off](const EffectQuery&, bool isOn) { return isOn ? on : off; };
}

// "2 point lights, 1 directional light"
std::string countLights(const std::vector<pack::LightSource>& lights) {
  std::string text;
  for (std::size_t kind = 0; kind < pack::kLightKindNames.size(); ++kind) {
    const auto count = std::ranges::count(lights, static_cast<pack::LightKind>(kind), &pack::LightSource::kind);
    if (count == 0) continue;
    text += fmt::format("{}{} {} light{}", text.empty() ? "" : ", ", count, pack::kLightKindNames[kind],
                        count == 1 ? "" : "s");
  }
  return text;
}

std::string areaLightReason(const EffectQuery& q, bool on) {
  if (on) return fmt::format("emitters that illuminate diffuse surfaces: {}", q.names(isAreaLight));
  if (!q.any(isAreaLight)) return "no emitter sets 'illuminates'";
  return q.isDiffuse() ? "no diffuse surface is in front of an emitter" : "no diffuse surface";
}

void removeSky(pack::Scene& scene) {
  pack::Environment& sky = scene.environment;
  sky.skyDegree = 0;
  sky.sun = glm::dvec3(0.0);
  if (sky.size > 0) return;
  sky.irradiance = {};
  sky.irradiance[0] = sky.radiance * std::numbers::pi;
}

}  // namespace

std::vector<EffectRule> lightRules() {
  return {
      {Effect::kPointLights, [](const EffectQuery& q) { return q.isLitByPointLights(); },
       [](const EffectQuery& q, bool on) {
         if (on) return countLights(q.scene.lights);
         return std::string(q.scene.lights.empty() ? "no point, spot or directional light"
                                                   : "no diffuse or glossy surface");
       },
       [](pack::Scene& scene) { scene.lights.clear(); }},
      {Effect::kShadows,
       [](const EffectQuery& q) { return q.isLit(); },
       either("lights on diffuse or glossy surfaces", "no surface is lit by lights"),
       {}},
      {Effect::kHighlights, [](const EffectQuery& q) { return q.hasHighlights(); },
       either("glossy materials and lights", "no glossy material with a light"),
       [](pack::Scene& scene) {
         for (Material& m : scene.materials) m.highlightStrength = 0;
       }},
      {Effect::kLightShapes,
       [](const EffectQuery& q) {
         return q.isLitByPointLights() && std::ranges::any_of(q.scene.lights, [](const pack::LightSource& light) {
                  return light.kind != pack::LightKind::point;
                });
       },
       {},
       {}},
      {Effect::kOrthographic, [](const EffectQuery& q) { return q.scene.camera.isOrthographic(); }, {}, {}},
      {Effect::kAmbient,
       [](const EffectQuery& q) {
         return q.isDiffuse() && q.scene.environment.ambientIrradiance > 0 && !q.scene.environment.illuminates;
       },
       {},
       {}},
      {Effect::kEnvironmentMap, [](const EffectQuery& q) { return q.scene.environment.size > 0; }, {}, {}},
      {Effect::kSky, [](const EffectQuery& q) { return q.scene.environment.hasSun(); },
       [](const EffectQuery& q, bool on) {
         return on ? fmt::format("Rayleigh sky, polarized up to {:g}", q.scene.environment.skyDegree)
                   : "the environment has no sun";
       },
       removeSky},
      {Effect::kAreaLights, [](const EffectQuery& q) { return q.isLitByAreaLights(); }, areaLightReason,
       [](pack::Scene& scene) {
         for (Material& m : scene.materials) m.illuminates = false;
       }},
      {Effect::kEnvironmentLight, [](const EffectQuery& q) { return q.isLitByEnvironment(); },
       [](const EffectQuery& q, bool on) -> std::string {
         if (on) return "the environment illuminates diffuse surfaces; without it, by its ambient irradiance";
         if (!q.scene.environment.illuminates) return "the environment does not set 'illuminates'";
         return q.hasEnvironment() ? "no diffuse surface" : "the environment is black";
       },
       [](pack::Scene& scene) { scene.environment.illuminates = false; }},
      {Effect::kFilteredShadows,
       [](const EffectQuery& q) { return q.filtersLight(); },
       [](const EffectQuery& q, bool on) -> std::string {
         if (on) return fmt::format("light passes {} on its way to other surfaces", q.names(isThinAndTransmits));
         return q.any(isThinAndTransmits) ? "no surface is lit by lights" : "no polarizing element or thin glass";
       },
       {}},
      {Effect::kEnvironment, [](const EffectQuery& q) { return q.hasEnvironment(); },
       [](const EffectQuery& q, bool on) -> std::string {
         if (!on) return "the environment is black";
         return q.scene.environment.size > 0 ? "environment given by an image" : "environment of constant radiance";
       },
       [](pack::Scene& scene) { scene.environment = {}; }},
  };
}

}  // namespace malus::bake
