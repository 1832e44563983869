#include "render/viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace malus::viewer {

namespace {
constexpr double kSteepestDegrees = 89.5;  // of a direction of view above or below the horizon

struct Angles {
  double yaw, pitch;  // radians: of the direction (sin yaw cos pitch, sin pitch, -cos yaw cos pitch)
};
Angles anglesFor(const glm::dvec3& direction) {
  const glm::dvec3 d = glm::normalize(direction);
  return {std::atan2(d.x, -d.z), std::asin(std::clamp(d.y, -1.0, 1.0))};
}
glm::dvec3 directionFor(const Angles& a) {
  return {std::sin(a.yaw) * std::cos(a.pitch), std::sin(a.pitch), -std::cos(a.yaw) * std::cos(a.pitch)};
}
double clampPitch(double pitch) {
  const double most = glm::radians(kSteepestDegrees);
  return std::clamp(pitch, -most, most);
}
}  // namespace

void placeUpright(pack::Camera& camera, const glm::dvec3& position, const glm::dvec3& forward) {
  Angles angles = anglesFor(forward);
  angles.pitch = clampPitch(angles.pitch);
  camera.position = position;
  camera.forward = directionFor(angles);
  camera.right = glm::normalize(glm::cross(camera.forward, glm::dvec3(0, 1, 0)));
  camera.up = glm::cross(camera.right, camera.forward);
}

void orbit(pack::Camera& camera, const glm::dvec3& pivot, double yawDegrees, double pitchDegrees) {
  const double distance = glm::length(pivot - camera.position);
  Angles angles = distance > 0 ? anglesFor(pivot - camera.position) : anglesFor(camera.forward);
  // A camera that moves to the right around the pivot turns to the left, and one that moves up looks down.
  angles.yaw -= glm::radians(yawDegrees);
  angles.pitch = clampPitch(angles.pitch - glm::radians(pitchDegrees));
  const glm::dvec3 direction = directionFor(angles);
  placeUpright(camera, pivot - distance * direction, direction);
}

void pan(pack::Camera& camera, glm::dvec3& pivot, double right, double up) {
  const double distance = glm::length(pivot - camera.position);
  const double height = camera.isOrthographic() ? camera.orthographicHeight
                                                : 2 * distance * std::tan(glm::radians(camera.verticalFovDegrees) / 2);
  const glm::dvec3 shift = height * (right * camera.right + up * camera.up);
  camera.position += shift;
  pivot += shift;
}

void zoom(pack::Camera& camera, const glm::dvec3& pivot, double factor) {
  camera.position = pivot + (camera.position - pivot) / factor;
  camera.orthographicHeight /= factor;
}

}  // namespace malus::viewer
