// The reference: double precision, full Stokes vectors and 4 x 4 Mueller matrices per colour, hit points
// refined in double, plain recursion. Slow and simple, so that a person can check it against optics.md.
#pragma once

#include "bake/pack/scene.h"
#include "render/scene/picture.h"
#include "render/scene/render_parameters.h"

namespace malus::reference {

// threads: 0 for all cores. The picture has Stokes channels. Throws Error.
render::Picture render(const pack::Scene& scene, const render::RenderParameters& parameters, unsigned threads);

}  // namespace malus::reference
