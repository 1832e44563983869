// The neutral studio: an environment that comes with malus and is computed, for models without lights.
//
// A grey room, lighter at the horizon, with three rectangular soft boxes without colour: the key light to the left
// of the camera and above it, a tall fill light to the right, and a rim light behind the model. The camera is at +z;
// a rotation (bakeEnvironment) turns the room toward another camera. The boxes are above 22 degrees of elevation, so
// that a camera that looks down does not see them directly.
#pragma once

#include "meshprep/base/image.h"

namespace malus::bake {

// Latitude-longitude image of 512 x 256 pixels (axes: octahedral_map.h). The irradiance of a surface that faces the key
// light, the largest, is pi within a few percent: a white diffuse surface there has the radiance 1.
image::Image studioImage();

}  // namespace malus::bake
