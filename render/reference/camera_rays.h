// Rays of the camera in double precision.
#pragma once

#include "render/reference/mueller.h"
#include "render/scene/image_plane.h"
#include "shaders/optics/optics.h"

namespace malus::reference {

// camera must outlive the rays. x, y: from 0 to 1 over the image, from its upper left corner.
class CameraRays {
 public:
  CameraRays(const pack::Camera& camera, double width, double height)
      : camera_(camera), plane_(render::makeImagePlane(camera, width, height)) {}
  // Unit.
  dvec3 direction(double x, double y) const {
    if (camera_.isOrthographic()) return camera_.forward;
    return f64::cameraDirection(camera_.right, camera_.up, plane_.middle, plane_.halfWidth, plane_.halfHeight, x, y);
  }
  // The pinhole, or a point of the image of an orthographic camera.
  dvec3 origin(double x, double y) const {
    if (!camera_.isOrthographic()) return camera_.position;
    return camera_.position + plane_.middle + camera_.right * ((2 * x - 1) * plane_.halfWidth) +
           camera_.up * ((1 - 2 * y) * plane_.halfHeight);
  }

 private:
  const pack::Camera& camera_;
  render::ImagePlane plane_;
};

}  // namespace malus::reference
