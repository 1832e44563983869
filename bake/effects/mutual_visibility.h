// Whether light can go from one interface to another: where it cannot, no path has two of them.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// False only where no point of an interface (metal, paint, mirror glass, glass) lies before a face of one: for a
// single flat mirror, a convex body, faces back to back. True where there is glass that transmits, no geometry,
// or too much of it to tell.
bool interfacesMutuallyVisible(const pack::Scene& scene);

// Height up to which corners count as in a face's plane: twice a step of a pack's grid (20 bits over the cube that
// holds every vertex), which bends flat surfaces by as much, and what float leaves of the largest coordinate.
double flatness(const pack::Scene& scene);

}  // namespace malus::bake
