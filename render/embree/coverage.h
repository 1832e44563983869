// Coverage: the share of a pixel's rays that meet a surface, for the alpha channel of an image.
#pragma once

#include <vector>

#include "bake/pack/scene.h"
#include "render/scene/render_parameters.h"

namespace malus::embree {

// Traces the camera's rays of every renderer, those of parameters.samples per axis, as far as their first surface, in a
// separate pass, so that the renderers need no further channel. Returns a value from 0 to 1 per pixel of the region,
// top row first: 1 where every ray meets a surface, of glass and of emitters too, whatever is seen through it; 0 where
// every ray leaves the scene toward the environment. Parts of a surface that its coverage map cuts out do not count.
// threads: 0 for all. Throws Error if Embree fails.
std::vector<float> coverage(const pack::Scene& scene, const render::RenderParameters& parameters, unsigned threads);

}  // namespace malus::embree
