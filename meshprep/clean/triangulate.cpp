#include "meshprep/clean/triangulate.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>

namespace malus::prep {

namespace {

constexpr double kPlanarTolerance = 1e-4;  // of the polygon's size
constexpr double kAreaTolerance = 1e-12;   // of its size squared: the rounding of a cross product in double

// A polygon in its own plane.
struct Flat {
  std::vector<std::uint32_t> corners;
  std::vector<glm::dvec2> points;
  double size = 0;
  bool planar = true;
};

double cross2(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

// Twice the signed area of a triangle of the polygon.
double area2(const Flat& flat, std::size_t a, std::size_t b, std::size_t c) {
  return cross2(flat.points[b] - flat.points[a], flat.points[c] - flat.points[a]);
}

// Projects along Newell's normal so that the polygon runs counter-clockwise.
Flat flatten(std::vector<std::uint32_t> corners, const std::vector<glm::dvec3>& positions) {
  Flat flat;
  const glm::dvec3 origin = positions[corners.front()];
  glm::dvec3 normal(0);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = positions[corners[i]] - origin;
    const glm::dvec3 b = positions[corners[(i + 1) % corners.size()]] - origin;
    normal += glm::cross(a, b);
    flat.size = std::max(flat.size, glm::length(a));
  }
  const double length = glm::length(normal);
  const glm::dvec3 n = length > 0 ? normal / length : glm::dvec3(0, 0, 1);

  // Any two axes at right angles to n, right-handed.
  const glm::dvec3 helper = std::abs(n.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 u = glm::normalize(glm::cross(helper, n));
  const glm::dvec3 v = glm::cross(n, u);
  glm::dvec3 centre(0);
  for (const std::uint32_t corner : corners)
    centre += (positions[corner] - origin) / static_cast<double>(corners.size());
  for (const std::uint32_t corner : corners) {
    const glm::dvec3 p = positions[corner] - origin;
    flat.points.emplace_back(glm::dot(p, u), glm::dot(p, v));
    if (std::abs(glm::dot(p - centre, n)) > kPlanarTolerance * flat.size) flat.planar = false;
  }
  flat.corners = std::move(corners);
  return flat;
}

// No corner turns right, and the boundary goes around once.
bool isConvex(const Flat& flat) {
  const std::size_t n = flat.points.size();
  double turn = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const glm::dvec2 a = flat.points[(i + 1) % n] - flat.points[i];
    const glm::dvec2 b = flat.points[(i + 2) % n] - flat.points[(i + 1) % n];
    if (cross2(a, b) < -kAreaTolerance * flat.size * flat.size) return false;
    turn += std::atan2(cross2(a, b), glm::dot(a, b));
  }
  return turn < 3 * 3.14159265358979;
}

// The first corner around which every triangle of a fan has area.
std::optional<std::size_t> fanCorner(const Flat& flat) {
  const std::size_t n = flat.points.size();
  for (std::size_t start = 0; start < n; ++start) {
    bool good = true;
    for (std::size_t i = 1; good && i + 1 < n; ++i)
      good = area2(flat, start, (start + i) % n, (start + i + 1) % n) > kAreaTolerance * flat.size * flat.size;
    if (good) return start;
  }
  return std::nullopt;
}

void addFan(const Flat& flat, std::size_t start, std::vector<glm::uvec3>& triangles) {
  const std::size_t n = flat.corners.size();
  for (std::size_t i = 1; i + 1 < n; ++i)
    triangles.emplace_back(flat.corners[start], flat.corners[(start + i) % n], flat.corners[(start + i + 1) % n]);
}

// Whether the triangle (a, b, c) of what is left can be cut off: it has area and holds no other corner.
bool isEar(const Flat& flat, const std::vector<std::size_t>& left, std::size_t at) {
  const std::size_t n = left.size();
  const std::size_t a = left[(at + n - 1) % n], b = left[at], c = left[(at + 1) % n];
  if (area2(flat, a, b, c) <= kAreaTolerance * flat.size * flat.size) return false;
  for (const std::size_t p : left) {
    const bool isCorner =
        flat.points[p] == flat.points[a] || flat.points[p] == flat.points[b] || flat.points[p] == flat.points[c];
    if (!isCorner && area2(flat, a, b, p) >= 0 && area2(flat, b, c, p) >= 0 && area2(flat, c, a, p) >= 0) return false;
  }
  return true;
}

// Returns false, having added nothing, where ears run out: the polygon crosses itself.
bool addEars(const Flat& flat, std::vector<glm::uvec3>& triangles) {
  std::vector<std::size_t> left(flat.corners.size());
  for (std::size_t i = 0; i < left.size(); ++i) left[i] = i;
  std::vector<glm::uvec3> ears;
  while (left.size() > 2) {
    std::size_t at = 0;
    while (at < left.size() && !isEar(flat, left, at)) ++at;
    if (at == left.size()) return false;
    const std::size_t n = left.size();
    ears.emplace_back(flat.corners[left[(at + n - 1) % n]], flat.corners[left[at]], flat.corners[left[(at + 1) % n]]);
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(at));
  }
  triangles.insert(triangles.end(), ears.begin(), ears.end());
  return true;
}

void addPolygon(std::span<const std::uint32_t> face, Mesh& mesh, TriangulateCounts& counts) {
  ++counts.polygons;

  // Step 1: leave out corners that repeat the one before.
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t corner : face)
    if (corners.empty() || mesh.positions[corner] != mesh.positions[corners.back()]) corners.push_back(corner);
  while (corners.size() > 1 && mesh.positions[corners.back()] == mesh.positions[corners.front()]) corners.pop_back();
  counts.repeatedCorners += face.size() - corners.size();
  if (corners.size() < 3) {  // no area at all: one degenerate triangle, for the next step to count
    mesh.triangles.emplace_back(face[0], face[1], face[2]);
    return;
  }
  if (corners.size() == 3) {
    mesh.triangles.emplace_back(corners[0], corners[1], corners[2]);
    return;
  }

  // Step 2: a fan where the polygon is convex, else ears, else a fan after all.
  const Flat flat = flatten(std::move(corners), mesh.positions);
  if (!flat.planar) ++counts.nonPlanar;
  const bool convex = isConvex(flat);
  if (!convex) ++counts.concave;
  if (const std::optional<std::size_t> start = convex ? fanCorner(flat) : std::nullopt) {
    addFan(flat, *start, mesh.triangles);
  } else if (!addEars(flat, mesh.triangles)) {
    ++counts.crossing;
    addFan(flat, 0, mesh.triangles);
  }
}

}  // namespace

Mesh triangulate(const Polygons& polygons, TriangulateCounts& counts) {
  Mesh mesh;
  mesh.positions = polygons.positions;
  for (std::size_t i = 0; i < polygons.faceCount(); ++i) {
    const std::span<const std::uint32_t> face = polygons.face(i);
    if (face.size() == 3) {
      mesh.triangles.emplace_back(face[0], face[1], face[2]);
    } else {
      addPolygon(face, mesh, counts);
    }
  }
  return mesh;
}

}  // namespace malus::prep
