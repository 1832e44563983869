// The effect set of a scene: which kinds of light transport its materials, lights and camera call for.
// Conservative: an effect that is off cannot show in any picture of the scene. Each has its reason.
#pragma once

#include <vector>

#include "bake/pack/scene.h"

namespace malus::bake {

// In the order in which they are listed everywhere.
std::vector<pack::Effect> findEffects(const pack::Scene& scene);

}  // namespace malus::bake
