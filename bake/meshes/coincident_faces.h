// Faces of opaque and thin surfaces that coincide with faces of glass, as those of a label on a bottle: a tie
// that each renderer resolves differently.
#pragma once

#include <string>
#include <vector>

#include "bake/pack/scene.h"

namespace malus::bake {

// Returns a warning for each pair of a mesh of glass and one of another kind with faces that overlap, nearer to each
// other than rays start (face_rounding.h). Surfaces that only cross are not reported: they have an order.
std::vector<std::string> inspectCoincidentFaces(const pack::Scene& scene);

}  // namespace malus::bake
