#include "render/scene/compiled_effects.h"

#include <algorithm>

#include <shaders/effects.h>

#include "render/scene/render_scene.h"

namespace malus::render {

using shaders::Effect;

static_assert(gpu::kPolarizingElement == static_cast<std::uint32_t>(Effect::kPolarizingElement),
              "kinds of surface come first");

std::uint32_t compiledEffects(const pack::Scene& scene, const RenderParameters& parameters) {
  if (parameters.everyEffect) return shaders::kEveryEffect;
  std::uint32_t bits = 0;
  const auto need = [&](Effect effect, bool needed) { bits |= needed ? shaders::bitOf(effect) : 0; };
  bool diffuse = false, glossy = false;
  std::vector<bool> used(scene.materials.size(), false);
  for (const pack::Mesh& mesh : scene.meshes) used[mesh.material] = true;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (!used[i]) continue;
    const pack::Material& m = scene.materials[i];
    bits |= 1u << surfaceKind(m.kind);
    diffuse = diffuse || m.albedo.x > 0 || m.albedo.y > 0 || m.albedo.z > 0;
    glossy = glossy || m.highlightStrength > 0;
    need(Effect::kTextures, m.maps.any());
    need(Effect::kAbsorption, m.absorption != glm::dvec3(0.0) || m.outsideAbsorption != glm::dvec3(0.0));
    need(Effect::kCoatings, m.coating.thicknessNm > 0);
    need(Effect::kRoughness, m.roughness > 0 && parameters.depth > 0);
    need(Effect::kPolarizedEmitters, pack::isEmitter(m.kind) && m.polarization > 0);
  }
  const bool lit = !scene.lights.empty() && (diffuse || glossy);
  need(Effect::kPointLights, lit);
  need(Effect::kShadows, lit && parameters.shadows);
  need(Effect::kHighlights, lit && glossy);
  need(Effect::kAmbient, diffuse && scene.environment.ambientIrradiance > 0);
  need(Effect::kEnvironmentMap, scene.environment.size > 0);
  need(Effect::kSky, scene.environment.hasSun());
  return bits;
}

std::uint32_t pathStackSize(std::uint32_t effects, std::uint32_t depth) {
  std::uint32_t ways = (effects & shaders::bitOf(Effect::kGlass)) != 0 ? std::max(depth, 1u) : 1;
  if ((effects & shaders::bitOf(Effect::kRoughness)) != 0) ways += gpu::kFacets;
  return ways;
}

}  // namespace malus::render
