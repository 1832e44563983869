// Whether light of emitting surfaces can reach diffuse surfaces.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// False only if no corner of a diffuse face is on the emitting side of an emitter that illuminates, or all corners of
// such emitters are in the planes of the diffuse faces. Surfaces between them are not considered. True if there are too
// many faces to compare.
bool emittersSeeDiffuseSurfaces(const pack::Scene& scene);

}  // namespace malus::bake
