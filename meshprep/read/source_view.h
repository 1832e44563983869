// Cameras and lights of a model file, in the coordinates of the file.
#pragma once

#include <optional>
#include <string>

#include <glm/vec3.hpp>

namespace malus::prep {

// Square pixels; the middle of the image is on the axis.
struct SourceCamera {
  std::string name;        // of its node
  std::string objectName;  // of the camera that the node places; empty if it has none
  glm::dvec3 position{0.0};
  glm::dvec3 forward{0.0, 0.0, -1.0}, up{0.0, 1.0, 0.0};  // unit, at right angles
  bool isOrthographic = false;
  double verticalFov = 0;        // radians, over 0, below pi; of a perspective camera
  double height = 0;             // of the visible part of the image plane, metres; of an orthographic camera
  std::optional<double> aspect;  // width / height; nothing: that of the image
};

// KHR_lights_punctual, in photometric units.
struct SourceLight {
  enum class Kind { point, spot, directional };
  Kind kind = Kind::point;
  std::string name;                      // of its node
  glm::dvec3 position{0.0};              // of point and spot lights
  glm::dvec3 direction{0.0, 0.0, -1.0};  // unit, in which the light of spot and directional lights travels
  glm::dvec3 intensity{1.0};             // candela, or lux of a directional light; per colour
  double innerConeAngle = 0,
         outerConeAngle = 0;  // of a spot light: radians from the direction, inner < outer <= pi / 2
};

}  // namespace malus::prep
