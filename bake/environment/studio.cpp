#include "bake/environment/studio.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace malus::bake {

namespace {

constexpr int kWidth = 512, kHeight = 256;
constexpr double kDegree = std::numbers::pi / 180;

// A rectangle on the sphere of directions. Angles in degrees; azimuth: from +z toward +x.
struct SoftBox {
  double azimuth, elevation;
  double halfWidth, halfHeight;
  double radiance;
};
constexpr std::array<SoftBox, 3> kBoxes = {{{-48, 48, 28, 20, 3.1}, {66, 46, 10, 22, 1.5}, {165, 50, 30, 12, 2.0}}};
constexpr double kFeather = 3;  // degrees over which an edge falls off
constexpr double kNadir = 0.16, kHorizon = 0.34, kZenith = 0.26;

glm::dvec3 direction(double azimuth, double elevation) {
  const double a = azimuth * kDegree, e = elevation * kDegree;
  return {std::cos(e) * std::sin(a), std::sin(e), std::cos(e) * std::cos(a)};
}

double smoothStep(double x) {
  const double t = std::min(std::max(x, 0.0), 1.0);
  return t * t * (3 - 2 * t);
}

double boxRadiance(const SoftBox& box, const glm::dvec3& d) {
  const glm::dvec3 forward = direction(box.azimuth, box.elevation);
  const double front = glm::dot(d, forward);
  if (front <= 0) return 0;
  const glm::dvec3 right = direction(box.azimuth + 90, 0), up = glm::cross(forward, right);
  const double x = std::abs(std::atan2(glm::dot(d, right), front)) / kDegree,
               y = std::abs(std::atan2(glm::dot(d, up), front)) / kDegree;
  return box.radiance * smoothStep((box.halfWidth - x) / kFeather + 0.5) *
         smoothStep((box.halfHeight - y) / kFeather + 0.5);
}

double radiance(const glm::dvec3& d) {
  double sum =
      d.y > 0 ? kHorizon + (kZenith - kHorizon) * smoothStep(d.y) : kHorizon + (kNadir - kHorizon) * smoothStep(-d.y);
  for (const SoftBox& box : kBoxes) sum += boxRadiance(box, d);
  return sum;
}

}  // namespace

image::Image studioImage() {
  image::Image image;
  image.width = kWidth;
  image.height = kHeight;
  image.channels = {"R", "G", "B"};
  image.pixels.reserve(std::size_t{3} * kWidth * kHeight);
  for (int y = 0; y < kHeight; ++y)
    for (int x = 0; x < kWidth; ++x) {
      // The centre column is toward -z, columns to its right toward +x.
      const double azimuth = 180 - (x + 0.5 - kWidth / 2.0) * 360 / kWidth, elevation = 90 - (y + 0.5) * 180 / kHeight;
      const auto value = static_cast<float>(radiance(direction(azimuth, elevation)));
      image.pixels.insert(image.pixels.end(), {value, value, value});
    }
  return image;
}

}  // namespace malus::bake
