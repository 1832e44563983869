// The camera of a model that has none: a three-quarter view that shows the whole model.
#pragma once

#include <glm/vec3.hpp>

namespace malus::bake {

// Direction from the model to the camera: from the front (+z, as glTF has it), turned to the right, from above.
inline constexpr double kFramingAzimuthDegrees = 35;  // from +z toward +x
inline constexpr double kFramingElevationDegrees = 20;
inline constexpr double kFramingFovDegrees = 30;  // vertical field of view
inline constexpr double kFramingMargin = 0.08;    // free part of the image at each edge, of half its size

struct FramingView {
  glm::dvec3 position, target;
};

// Looks at the centre of the box, +y up, from the least distance at which its eight corners are in the image, within
// the margin, and in front of the camera. low, high: finite, low <= high, not equal in every axis. aspect: width /
// height.
FramingView frameBox(const glm::dvec3& low, const glm::dvec3& high, double aspect);

}  // namespace malus::bake
