// How wrong a picture can be that leaves polarization out.
#pragma once

#include <glm/vec3.hpp>

#include "bake/effects/effects.h"

namespace malus::bake {

// Largest error of the unpolarized intensity relative to itself, per colour: (prod(1 + D) + prod(1 - D))/2 - 1 over
// the longest chain of diattenuating elements that the picture's depth and filter allow, each at its largest D of any
// angle (derived in shaders/optics/CONVENTIONS.md). 0 where at most one stands on any
// path. Relative to the truth there is no bound, because the truth may be 0.
glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const ImageRequest& request);

}  // namespace malus::bake
