#include "render/scene/left_out.h"

#include <algorithm>

#include "bake/effects/effects.h"

namespace malus::render {

void switchOff(const std::vector<std::string>& off, RenderParameters& parameters) {
  const auto isOff = [&](shaders::Effect effect) {
    return std::any_of(off.begin(), off.end(),
                       [&](const std::string& name) { return bake::effectNamed(name) == effect; });
  };
  if (isOff(shaders::Effect::kShadows)) parameters.shadows = false;
  if (isOff(shaders::Effect::kFilteredShadows)) parameters.filteredShadows = false;
  if (isOff(shaders::Effect::kFilter)) parameters.analyser = kNoFilter;
}

std::shared_ptr<const pack::Scene> leaveOut(const pack::Scene& scene, const std::vector<std::string>& off,
                                            RenderParameters& parameters) {
  switchOff(off, parameters);
  if (!bake::canBeRemoved(off)) return nullptr;
  return std::make_shared<const pack::Scene>(bake::withoutEffects(scene, off));
}

}  // namespace malus::render
