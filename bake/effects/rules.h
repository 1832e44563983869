// The rule of each effect: whether an image of a scene needs it, the reason, and how it is removed from a scene.
// `malus info`, the baker, --effects and the variants of the shaders all decide by these rules.
//
// A row of shaders/effects.def that is a kind of surface needs no rule: it is on if a mesh has a material of that
// surface, and without it the surface becomes the diffuse surface below its interface.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bake/effects/query.h"
#include "shaders/effects.h"

namespace malus::bake {

struct EffectRule {
  shaders::Effect effect;
  std::function<bool(const EffectQuery&)> isOn;
  std::function<std::string(const EffectQuery&, bool on)> reason;  // one line; empty if it is not listed
  std::function<void(pack::Scene&)> remove;                        // empty if only a renderer can leave it out
};

// In the order of the effects; one rule per effect.
const std::vector<EffectRule>& effectRules();

// The rules by the part of the scene that they read.
std::vector<EffectRule> surfaceRules();
std::vector<EffectRule> materialRules();
std::vector<EffectRule> lightRules();
std::vector<EffectRule> polarizationRules();

// A rule that is on if a used material has a property; removeFrom changes each material of a scene.
EffectRule materialRule(shaders::Effect effect, const EffectQuery::Predicate& predicate,
                        const std::function<void(pack::Material&)>& removeFrom);

}  // namespace malus::bake
