#include <algorithm>
#include <numbers>

#include <fmt/format.h>

#include "bake/effects/rules.h"

namespace malus::bake {
using pack::Material;
using shaders::Effect;

namespace {

bool isDiffuse(const EffectQuery& q) { return q.any(isDiffuseMaterial); }

bool hasHighlights(const EffectQuery& q) {
  return q.reflects() && !q.scene.lights.empty() && q.any([](const Material& m) { return m.highlightStrength > 0; });
}

bool isLitByPointLights(const EffectQuery& q) { return !q.scene.lights.empty() && (isDiffuse(q) || hasHighlights(q)); }

// Returns one of two constant reasons.
std::function<std::string(const EffectQuery&, bool)> either(const char* on, const char* off) {
  return [on, off](const EffectQuery&, bool isOn) { return isOn ? on : off; };
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
      {Effect::kPointLights, isLitByPointLights,
       [](const EffectQuery& q, bool on) {
         if (on) return fmt::format("{} point lights", q.scene.lights.size());
         return std::string(q.scene.lights.empty() ? "no point light" : "no diffuse or glossy surface");
       },
       [](pack::Scene& scene) { scene.lights.clear(); }},
      {Effect::kShadows,
       isLitByPointLights,
       either("point lights on diffuse or glossy surfaces", "no surface is lit by point lights"),
       {}},
      {Effect::kHighlights, hasHighlights,
       either("glossy materials and point lights", "no glossy material with a point light"),
       [](pack::Scene& scene) {
         for (Material& m : scene.materials) m.highlightStrength = 0;
       }},
      {Effect::kLightShapes,
       [](const EffectQuery& q) {
         return isLitByPointLights(q) && std::ranges::any_of(q.scene.lights, [](const pack::LightSource& light) {
                  return light.kind != pack::LightKind::point;
                });
       },
       {},
       {}},
      {Effect::kOrthographic, [](const EffectQuery& q) { return q.scene.camera.isOrthographic(); }, {}, {}},
      {Effect::kAmbient,
       [](const EffectQuery& q) { return isDiffuse(q) && q.scene.environment.ambientIrradiance > 0; },
       {},
       {}},
      {Effect::kEnvironmentMap, [](const EffectQuery& q) { return q.scene.environment.size > 0; }, {}, {}},
      {Effect::kSky, [](const EffectQuery& q) { return q.scene.environment.hasSun(); },
       [](const EffectQuery& q, bool on) {
         return on ? fmt::format("Rayleigh sky, polarized up to {:g}", q.scene.environment.skyDegree)
                   : "the environment has no sun";
       },
       removeSky},
      {Effect::kEnvironment, [](const EffectQuery& q) { return q.hasEnvironment(); },
       [](const EffectQuery& q, bool on) -> std::string {
         if (!on) return "the environment is black";
         return q.scene.environment.size > 0 ? "environment given by an image" : "environment of constant radiance";
       },
       [](pack::Scene& scene) { scene.environment = {}; }},
  };
}

}  // namespace malus::bake
