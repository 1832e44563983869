#include "bake/meshes/face_rounding.h"

#include <algorithm>
#include <utility>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

constexpr double kUnitRoundoff = 0x1p-24;  // of float

}  // namespace

FaceRounding faceRounding(const Corners& face, const glm::dvec3& origin, double b1, double b2) {
  const auto& [a, b, c] = face;
  const glm::dvec3 e1 = b - a, e2 = c - a, across = glm::cross(e1, e2);
  const double area = glm::length(across);
  if (!(area > 0)) return {};
  const glm::dvec3 normal = across / area, point = f64::trianglePoint(a, e1, e2, b1, b2),
                   hit = f64::hitPointError(a - origin, e1, e2, b1, b2, kUnitRoundoff),
                   error = hit + f64::originError(origin, kUnitRoundoff) +
                           glm::dvec3(f64::intersectionError(a, b, c, point, kUnitRoundoff)),
                   start = f64::rayOrigin(point, error, normal, kUnitRoundoff);
  return {glm::dot(hit, glm::abs(normal)), glm::dot(start - point, normal)};
}

double largestStart(const Corners& face, const glm::dvec3& origin) {
  double largest = 0;
  for (const auto& [b1, b2] : {std::pair(0.0, 0.0), std::pair(1.0, 0.0), std::pair(0.0, 1.0)})
    largest = std::max(largest, faceRounding(face, origin, b1, b2).start);
  return largest;
}

double boundStart(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin) {
  // The errors grow with the coordinates and the edges, and are largest along a diagonal.
  const glm::dvec3 extent = high - low, farthest = glm::max(glm::abs(low - origin), glm::abs(high - origin)), none(0.0),
                   error = f64::hitPointError(farthest, extent, none, 1, 0, kUnitRoundoff) +
                           f64::originError(origin, kUnitRoundoff) +
                           glm::dvec3(f64::intersectionError(low, high, high, low, kUnitRoundoff)),
                   point = glm::max(glm::abs(low), glm::abs(high)) + error;
  return glm::length(error) + glm::length(f64::rayOrigin(point, none, none, kUnitRoundoff) - point);
}

}  // namespace malus::bake
