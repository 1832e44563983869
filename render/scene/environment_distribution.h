// Distribution of the samples of an image environment that lights surfaces.
#pragma once

#include <vector>

#include "bake/pack/scene.h"

namespace malus::render {

// Cumulative distributions over an octahedral map of `size` texels per side, size + 1 numbers from 0 to 1 each: of the
// rows, then of the columns of each row. The weight of a texel is its solid angle times the mean radiance of the
// colours in it, of bilinear interpolation. Empty if the environment has no map.
std::vector<float> environmentDistributions(const pack::Environment& environment);

}  // namespace malus::render
