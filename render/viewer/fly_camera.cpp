#include "render/viewer/fly_camera.h"

#include "render/viewer/orbit_camera.h"

namespace malus::viewer {

void fly(pack::Camera& camera, double forward, double right, double up) {
  camera.position += forward * camera.forward + right * camera.right + up * camera.up;
}

void look(pack::Camera& camera, double yawDegrees, double pitchDegrees) {
  // A turn to the right in place is an orbit around the camera's own position, with the view's angles reversed.
  const glm::dvec3 position = camera.position;
  orbit(camera, position + camera.forward, -yawDegrees, -pitchDegrees);
  camera.position = position;
}

glm::dvec3 pivotAhead(const pack::Camera& camera, double distance) {
  return camera.position + distance * camera.forward;
}

}  // namespace malus::viewer
