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

struct FaceErrors {
  double rounding = 0;  // of a way from or to the face, along its normal
  double start = 0;     // distance from the face at which rays start
};

// At the centre of a face. origin: of the mesh.
FaceErrors faceErrors(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, const glm::dvec3& origin) {
  const glm::dvec3 e1 = b - a, e2 = c - a, across = glm::cross(e1, e2);
  const double area = glm::length(across);
  if (!(area > 0)) return {};
  constexpr double kThird = 1.0 / 3;
  const glm::dvec3 centre = (a + b + c) * kThird;
  const glm::dvec3 point = f64::hitPointError(a - origin, e1, e2, kThird, kThird, kUnitRoundoff),
                   start = point + f64::originError(origin, kUnitRoundoff) +
                           glm::dvec3(f64::intersectionError(a, b, c, centre, kUnitRoundoff));
  return {glm::dot(point, glm::abs(across)) / area, glm::dot(start, glm::abs(across)) / area};
}

// Twice the volume over the area: the thickness of a large pane.
double meanThickness(const pack::Mesh& mesh) {
  double volume = 0, area = 0;
  const glm::dvec3& foot = mesh.positions.front();
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 a = mesh.positions[t.x] - foot, b = mesh.positions[t.y] - foot, c = mesh.positions[t.z] - foot;
    volume += glm::dot(a, glm::cross(b, c)) / 6;
    area += glm::length(glm::cross(b - a, c - a)) / 2;
  }
  return area > 0 ? 2 * std::abs(volume) / area : 0;
}

}  // namespace

std::optional<AbsorptionPrecision> insufficientAbsorptionPrecision(const pack::Mesh& mesh,
                                                                   const pack::Material& material) {
  const bool isBody = pack::hasInside(material.kind);
  const double inside = isBody ? largest(material.absorption) : 0,
               absorption = std::max(inside, largest(material.outsideAbsorption));
  if (!(absorption > 0) || mesh.positions.empty()) return std::nullopt;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec3 origin = (low + high) * 0.5;  // the pack's differs by less than the box
  // The mean over the area: the rims of a pane do not count.
  FaceErrors mean;
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    const FaceErrors face = faceErrors(a, b, c, origin);
    const double weight = glm::length(glm::cross(b - a, c - a));
    mean.rounding += weight * face.rounding, mean.start += weight * face.start, area += weight;
  }
  if (!(area > 0)) return std::nullopt;
  mean = {mean.rounding / area, mean.start / area};
  AbsorptionPrecision found{mean.rounding, std::expm1(absorption * mean.rounding), 0};
  if (inside > 0 && !mesh.openSurface)
    if (const double thickness = meanThickness(mesh); thickness > 0 && thickness <= mean.start)
      found = {mean.start, std::expm1(inside * thickness), thickness};
  if (found.error <= kAbsorptionPrecision) return std::nullopt;
  return found;
}

}  // namespace malus::bake
