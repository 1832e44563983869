// Motions of a camera by the mouse, around a pivot. Pure functions; the camera keeps its projection and stays upright:
// the horizon of the world's y axis stays level.
#pragma once

#include "bake/pack/scene.h"

namespace malus::viewer {

// Looks from `position` along `forward`, upright. forward: any length but 0; nearly vertical directions are turned away
// from the axis by half a degree.
void placeUpright(pack::Camera& camera, const glm::dvec3& position, const glm::dvec3& forward);

// Turns the camera around the pivot: yaw about the y axis, then pitch; positive moves it to the right and upward
// around the pivot [degrees]. The distance is kept.
void orbit(pack::Camera& camera, const glm::dvec3& pivot, double yawDegrees, double pitchDegrees);

// Moves camera and pivot parallel to the image, by shares of the height of the image at the distance of the pivot.
void pan(pack::Camera& camera, glm::dvec3& pivot, double right, double up);

// Divides the distance to the pivot by factor > 0; of an orthographic camera also the height of the image.
void zoom(pack::Camera& camera, const glm::dvec3& pivot, double factor);

}  // namespace malus::viewer
