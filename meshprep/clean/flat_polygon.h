// Polygon projected to its plane, counter-clockwise, for both triangulations (convex_polygon.h, ears.h). Corners are
// indices from 0 in boundary order.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace malus::prep {

struct FlatPolygon {
  std::vector<glm::dvec2> points;
  double size = 0;     // largest distance of a corner from the first
  bool planar = true;  // all corners are within 1e-4 of the size of the plane
};

// Projects along Newell's normal so that the polygon runs counter-clockwise.
FlatPolygon flatten(const std::vector<glm::dvec3>& corners);

inline double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Returns twice the signed area of a triangle of corners.
inline double area2(const FlatPolygon& flat, std::size_t a, std::size_t b, std::size_t c) {
  return cross2(flat.points[b] - flat.points[a], flat.points[c] - flat.points[a]);
}

// Returns a bound of the rounding error of cross2(a, b) for differences of points, whose coordinates have rounding
// errors relative to the polygon's size.
inline double rounding(const FlatPolygon& flat, const glm::dvec2& a, const glm::dvec2& b) {
  return 4e-15 * flat.size * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
}

// Returns true if a triangle of corners is counter-clockwise and has an area above rounding errors.
inline bool hasArea(const FlatPolygon& flat, std::size_t a, std::size_t b, std::size_t c) {
  const glm::dvec2 u = flat.points[b] - flat.points[a], v = flat.points[c] - flat.points[a];
  return cross2(u, v) > rounding(flat, u, v);
}

}  // namespace malus::prep
