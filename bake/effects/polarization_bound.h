// Bound on the error of an image without polarization.
#pragma once

#include <glm/vec3.hpp>

#include "bake/effects/effects.h"

namespace malus::bake {

// Returns the largest relative error of the unpolarized intensity, per colour: (prod(1 + D) + prod(1 - D))/2 - 1 over
// the longest chain of diattenuating elements that the depth and the filter of the image allow, each with its largest
// diattenuation D at any angle (derived in shaders/optics/CONVENTIONS.md). 0 if no path has two of them. Relative to
// the exact intensity there is no bound, because that may be 0.
glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const ImageRequest& request);

}  // namespace malus::bake
