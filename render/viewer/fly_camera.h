// Free flight of the camera: keys move it, the mouse turns it. Pure functions.
#pragma once

#include "bake/pack/scene.h"

namespace malus::viewer {

// Moves the camera along its axes [metres].
void fly(pack::Camera& camera, double forward, double right, double up);

// Turns the view in place: positive looks to the right and upward [degrees].
void look(pack::Camera& camera, double yawDegrees, double pitchDegrees);

// The pivot of later orbits: straight ahead, at the distance that the last one had.
glm::dvec3 pivotAhead(const pack::Camera& camera, double distance);

}  // namespace malus::viewer
