#include "meshprep/clean/degenerate_faces.h"

#include <algorithm>
#include <cmath>

#include <glm/geometric.hpp>

namespace malus::prep {

namespace {

constexpr double kAreaTolerance = 1e-12;  // a few thousand roundings of a cross product

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

bool isWithoutArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  // Scaled first: squares of very small or large edges leave the range of double.
  const double scale = std::max({largest(b - a), largest(c - b), largest(a - c)});
  if (scale == 0) return true;
  const glm::dvec3 u = (b - a) / scale, v = (c - a) / scale;
  const double longest = std::max({glm::length(u), glm::length(v), glm::length(v - u)});
  return glm::length(glm::cross(u, v)) <= kAreaTolerance * longest * longest;
}

}  // namespace

DegenerateCounts dropDegenerateFaces(Mesh& mesh) {
  DegenerateCounts counts;
  std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
    if (t.x == t.y || t.y == t.z || t.z == t.x) {
      ++counts.repeatedCorner;
      return true;
    }
    if (isWithoutArea(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z])) {
      ++counts.zeroArea;
      return true;
    }
    return false;
  });
  return counts;
}

}  // namespace malus::prep
