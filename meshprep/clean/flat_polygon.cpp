#include "meshprep/clean/flat_polygon.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr double kPlanarTolerance = 1e-4;  // relative to the polygon's size

}  // namespace

FlatPolygon flatten(const std::vector<glm::dvec3>& corners) {
  FlatPolygon flat;
  const glm::dvec3 origin = corners.front();
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = corners[i] - origin;
    const glm::dvec3 b = corners[(i + 1) % corners.size()] - origin;
    normal += glm::cross(a, b);
    flat.size = std::max(flat.size, glm::length(a));
  }
  const double length = glm::length(normal);
  const glm::dvec3 n = length > 0 ? normal / length : glm::dvec3(0, 0, 1);

  // Choose axes u, v perpendicular to n, right-handed.
  const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, n));
  const glm::dvec3 v = glm::cross(n, u);
  glm::dvec3 centre(0);
  for (const glm::dvec3& corner : corners) centre += (corner - origin) / static_cast<double>(corners.size());
  flat.points.reserve(corners.size());
  for (const glm::dvec3& corner : corners) {
    const glm::dvec3 p = corner - origin;
    flat.points.emplace_back(glm::dot(p, u), glm::dot(p, v));
    if (std::abs(glm::dot(p - centre, n)) > kPlanarTolerance * flat.size) flat.planar = false;
  }
  return flat;
}

}  // namespace malus::prep
