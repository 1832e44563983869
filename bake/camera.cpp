#include "bake/camera.h"

#include <cmath>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "bake/pack/format.h"
#include "meshprep/base/error.h"

namespace malus::bake {

void placeCamera(const glm::dvec3& position, const glm::dvec3& target, const glm::dvec3& up, std::string_view where,
                 pack::Camera& camera) {
  const glm::dvec3 toTarget = target - position;
  if (glm::length(toTarget) == 0) throw Error(where, "camera.target: equals camera.position", "another point");
  camera.position = position;
  camera.forward = glm::normalize(toTarget);
  const glm::dvec3 right = glm::cross(camera.forward, up);
  if (glm::length(right) <= 1e-9 * glm::length(up))
    throw Error(where, "camera.up: is parallel to the view", "a direction that is not parallel to target - position");
  camera.right = glm::normalize(right);
  camera.up = glm::cross(camera.right, camera.forward);
}

void setIntrinsics(const Intrinsics& i, double width, double height, std::string_view where, pack::Camera& camera) {
  constexpr double kLeastFov = 1e-3, kMostFov = 179, kMostAspect = 1e3;  // of a pack (bake/pack/record_fields.h)
  const auto require = [&](bool isInRange, const char* key, const std::string& expected) {
    if (!isInRange) throw Error(where, fmt::format("camera.intrinsics.{}: is out of range", key), expected);
  };
  camera.verticalFovDegrees = 2 * std::atan(height / (2 * i.fy)) * 180 / std::numbers::pi;
  require(camera.verticalFovDegrees >= kLeastFov && camera.verticalFovDegrees <= kMostFov, "fy",
          fmt::format("a vertical field of view of {:g} to {:g} degrees", kLeastFov, kMostFov));
  camera.pixelAspect = i.fy / i.fx;
  require(camera.pixelAspect >= 1 / kMostAspect && camera.pixelAspect <= kMostAspect, "fx",
          fmt::format("{:g} to {:g} times fy", 1 / kMostAspect, kMostAspect));
  camera.middleX = (width / 2.0 - i.cx) * camera.pixelAspect / height;
  camera.middleY = (i.cy - height / 2.0) / height;
  require(std::abs(camera.middleX) <= pack::kMaxImageShift, "cx", "a point near the image");
  require(std::abs(camera.middleY) <= pack::kMaxImageShift, "cy", "a point near the image");
}

}  // namespace malus::bake
