// Measurement of the difference that polarization makes in a small image of a scene, for `malus info`.
#pragma once

#include "bake/polarization_probe.h"

namespace malus::render {

// Renders 64 pixels along the longer side with Embree, by the complete iterative method and by that without
// polarization. Paths of less than 1e-4 of a source's radiance are left out, so that many panes take no longer. Throws
// as Renderer::render() does.
bake::PolarizationProbe probePolarization(const pack::Scene& scene);

}  // namespace malus::render
