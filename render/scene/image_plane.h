// The image plane of a camera: at distance 1 of a pinhole, or the image of an orthographic camera.
#pragma once

#include <cmath>
#include <numbers>

#include "bake/pack/scene.h"

namespace malus::render {

// Its points are middle + x halfWidth right + y halfHeight up, with x and y from -1 to 1, from the camera's position.
// Lengths are in units of the distance of a perspective camera, in metres of an orthographic one.
struct ImagePlane {
  double halfWidth, halfHeight;
  glm::dvec3 middle;
};

// width, height: of the image, in pixels. An image of another aspect than the scene's keeps its height.
inline ImagePlane makeImagePlane(const pack::Camera& camera, double width, double height) {
  const double halfHeight = camera.isOrthographic() ? camera.orthographicHeight / 2
                                                    : std::tan(camera.verticalFovDegrees / 360 * std::numbers::pi);
  const glm::dvec3 offset =
      camera.right * (2 * halfHeight * camera.middleX) + camera.up * (2 * halfHeight * camera.middleY);
  return {halfHeight * width / height * camera.pixelAspect, halfHeight,
          camera.isOrthographic() ? offset : camera.forward + offset};
}

}  // namespace malus::render
