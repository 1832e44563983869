#include "bake/materials/absorption_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "shaders/optics/optics.h"

namespace malus::bake {

namespace {

constexpr double kUnitRoundoff = 0x1p-24;  // of float

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

// Distance from the centre of a face at which the renderers start rays. origin: of the mesh.
double startDistance(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& origin) {
  const glm::dvec3 e1 = b - a, e2 = c - a, across = glm::cross(e1, e2);
  const double area = glm::length(across);
  if (!(area > 0)) return 0;
  constexpr double kThird = 1.0 / 3;
  const glm::dvec3 centre = (a + b + c) * kThird;
  const glm::dvec3 error = f64::hitPointError(a - origin, e1, e2, kThird, kThird, kUnitRoundoff) +
                           f64::originError(origin, kUnitRoundoff) +
                           glm::dvec3(f64::intersectionError(a, b, c, centre, kUnitRoundoff));
  return glm::dot(error, glm::abs(across)) / area;
}

}  // namespace

std::optional<AbsorptionPrecision> insufficientAbsorptionPrecision(const pack::Mesh& mesh,
                                                                   const pack::Material& material) {
  const double absorption =
      std::max(pack::hasInside(material.kind) ? largest(material.absorption) : 0, largest(material.outsideAbsorption));
  if (!(absorption > 0) || mesh.positions.empty()) return std::nullopt;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec3 origin = (low + high) * 0.5;  // the pack's differs by less than the box
  double distance = 0;
  for (const glm::uvec3& t : mesh.triangles)
    distance = std::max(distance, startDistance(mesh.positions[t.x], mesh.positions[t.y], mesh.positions[t.z], origin));
  const double error = std::expm1(absorption * distance);
  if (error <= kAbsorptionPrecision) return std::nullopt;
  return AbsorptionPrecision{distance, error};
}

}  // namespace malus::bake
