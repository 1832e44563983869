// Bound on the error of an image without polarization.
#pragma once

#include <glm/vec3.hpp>

#include "bake/effects/effects.h"

namespace malus::bake {

// Returns the largest relative error of the unpolarized intensity, per colour: (prod(1 + D) + prod(1 - D))/2 - 1 over
// the chains of diattenuating elements that the depth and the filter of the image allow (derived in
// shaders/optics/CONVENTIONS.md). Each element has its largest diattenuation D over the angles at which light can
// travel to it from the element before (interface_patches.h). 0 if no path has two of them. Relative to the exact
// intensity there is no bound, because that may be 0.
glm::dvec3 polarizationErrorBound(const pack::Scene& scene, const ImageRequest& request);

// Whether a bound restricts an image: an error of at most 100 % for each colour.
bool isUseful(const glm::dvec3& polarizationErrorBound);

}  // namespace malus::bake
