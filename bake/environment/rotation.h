// Rotation of a baked environment.
#pragma once

#include "bake/pack/scene.h"

namespace malus::bake {

// Rotates an environment counter-clockwise about +y seen from above, as rotationDegrees of bakeEnvironment() does. Sun
// and irradiance are exact; a map is resampled at its size, each texel as the mean of bilinear lookups over its area,
// so that details of the size of a texel are blurred once more. An angle of 0 changes nothing.
void rotateEnvironment(double degrees, pack::Environment& environment);

}  // namespace malus::bake
