// Whether light can travel from one interface to another; if not, no path has two of them.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// False only if no point of an interface is in front of a face of an interface: a single flat mirror, a convex body,
// faces back to back. True if an interface transmits, if there is no geometry, or if there are too many faces to
// compare.
bool interfacesMutuallyVisible(const pack::Scene& scene);

// Height in metres up to which a corner counts as in the plane of a face: two steps of a pack's position grid (20 bits
// over the cube that contains all vertices), by which quantization bends flat surfaces, and the float rounding of the
// largest coordinate.
double flatness(const pack::Scene& scene);

}  // namespace malus::bake
