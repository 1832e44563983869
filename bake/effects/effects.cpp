#include "bake/effects/effects.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "bake/effects/rules.h"
#include "meshprep/base/error.h"
#include "meshprep/base/nearest_name.h"

namespace malus::bake {
using shaders::Effect;

const std::vector<EffectRule>& effectRules() {
  static const std::vector<EffectRule> kRules = [] {
    std::vector<EffectRule> rules;
    for (const auto& group : {surfaceRules(), materialRules(), lightRules(), polarizationRules()})
      rules.insert(rules.end(), group.begin(), group.end());
    std::sort(rules.begin(), rules.end(), [](const EffectRule& a, const EffectRule& b) { return a.effect < b.effect; });
    return rules;
  }();
  return kRules;
}

std::vector<pack::Effect> findEffects(const pack::Scene& scene) {
  ImageRequest request;
  request.depth = scene.depth;
  return findEffects(scene, request);
}

std::vector<pack::Effect> findEffects(const pack::Scene& scene, const ImageRequest& request) {
  const EffectQuery query(scene, request);
  std::vector<pack::Effect> effects;
  for (const EffectRule& rule : effectRules()) {
    const std::string_view name = shaders::effectName(rule.effect);
    if (name.empty()) continue;
    const bool on = rule.isOn(query);
    effects.push_back({std::string(name), on, rule.reason(query, on)});
  }
  return effects;
}

std::uint32_t findCompiledEffects(const pack::Scene& scene, const ImageRequest& request) {
  const EffectQuery query(scene, request);
  std::uint32_t bits = 0;
  for (const EffectRule& rule : effectRules())
    if (static_cast<std::size_t>(rule.effect) < shaders::kCompiledEffects.size() && rule.isOn(query))
      bits |= shaders::effectBit(rule.effect);
  return bits;
}

bool isOn(const std::vector<pack::Effect>& effects, Effect effect) {
  return std::any_of(effects.begin(), effects.end(),
                     [&](const pack::Effect& e) { return e.on && shaders::effectNamed(e.name) == effect; });
}

bool isOn(const std::vector<pack::Effect>& effects, std::string_view name) { return isOn(effects, effectNamed(name)); }

std::vector<std::string> effectNames() {
  std::vector<std::string> names;
  for (const shaders::EffectInfo& e : shaders::kEffects)
    if (!e.name.empty()) names.emplace_back(e.name);
  return names;
}

Effect effectNamed(std::string_view name) {
  if (const auto effect = shaders::effectNamed(name)) return *effect;
  throw Error("--effects", fmt::format("unknown effect '{}'{}", name, nearestClause(name, effectNames())),
              fmt::format("auto, all, or some of {}", fmt::join(effectNames(), ", ")));
}

Effect surfaceEffect(pack::MaterialKind kind) {
  static constexpr Effect kSurfaces[] = {
#define MALUS_MATERIAL_KIND(kind, value, name, surface, traits, summary) Effect::surface,
#include "bake/pack/material_kinds.def"
#undef MALUS_MATERIAL_KIND
  };
  return kSurfaces[static_cast<std::size_t>(kind)];
}

pack::Scene withoutEffects(pack::Scene scene, const std::vector<std::string>& off) {
  std::set<Effect> removed;
  for (const std::string& name : off) {
    if (effectNamed(name) == Effect::kTir)
      throw Error("--effects", "'tir' cannot be removed alone", "dielectric or glass");
    removed.insert(effectNamed(name));
  }
  for (const EffectRule& rule : effectRules())
    if (removed.contains(rule.effect) && rule.remove) rule.remove(scene);
  return scene;
}

bool canBeRemoved(const std::vector<std::string>& off) {
  return std::any_of(off.begin(), off.end(), [](const std::string& name) {
    return static_cast<bool>(effectRules()[static_cast<std::size_t>(effectNamed(name))].remove);
  });
}

}  // namespace malus::bake
