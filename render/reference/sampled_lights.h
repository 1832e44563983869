// Samples of the lights that are extended, emitting surfaces and the environment: the numbers of
// shaders/surfaces/sampled_lights.h in double precision.
#pragma once

#include <cstdint>
#include <vector>

#include "render/reference/lights.h"

namespace malus::reference {

// Appends the samples of a diffuse hit, and the ways to them. path: the path word of the ray that met it.
void findSampledArrivals(const SceneAccess& access, const Hit& hit, std::uint32_t path, std::vector<Arrival>& arrivals,
                         std::vector<ShadowRay>& ways);

}  // namespace malus::reference
