// A polygon in a plane of its own, counter-clockwise, for the two ways to cut it into triangles. Corners are numbers
// from 0 in the order of the boundary.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

namespace malus::prep {

struct FlatPolygon {
  std::vector<glm::dvec2> points;
  double size = 0;  // the farthest corner from the first
  bool planar = true;
};

inline double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Twice the signed area of a triangle of the polygon.
inline double area2(const FlatPolygon& flat, std::size_t a, std::size_t b, std::size_t c) {
  return cross2(flat.points[b] - flat.points[a], flat.points[c] - flat.points[a]);
}

// What a cross product of two differences of points may be off by: their coordinates are rounded in double, relative to
// the polygon's size, however short the differences are.
inline double rounding(const FlatPolygon& flat, const glm::dvec2& a, const glm::dvec2& b) {
  return 4e-15 * flat.size * (std::abs(a.x) + std::abs(a.y) + std::abs(b.x) + std::abs(b.y));
}

// Whether a triangle of the polygon goes around counter-clockwise and has an area beyond rounding.
inline bool hasArea(const FlatPolygon& flat, std::size_t a, std::size_t b, std::size_t c) {
  const glm::dvec2 u = flat.points[b] - flat.points[a], v = flat.points[c] - flat.points[a];
  return cross2(u, v) > rounding(flat, u, v);
}

}  // namespace malus::prep
