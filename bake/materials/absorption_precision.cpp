#include "bake/materials/absorption_precision.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "bake/meshes/face_rounding.h"

namespace malus::bake {

namespace {

double largest(const glm::dvec3& v) { return std::max({v.x, v.y, v.z}); }

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

// Of a body.
double largestInside(const pack::Material& material) {
  return pack::hasInside(material.kind) ? largest(material.absorption) : 0;
}

}  // namespace

bool absorbs(const pack::Material& material) {
  return std::max(largestInside(material), largest(material.outsideAbsorption)) > 0;
}

std::optional<AbsorptionPrecision> insufficientAbsorptionPrecision(const pack::Mesh& mesh,
                                                                   const pack::Material& material) {
  const double inside = largestInside(material), absorption = std::max(inside, largest(material.outsideAbsorption));
  if (!(absorption > 0) || mesh.positions.empty()) return std::nullopt;
  glm::dvec3 low(std::numeric_limits<double>::max()), high(std::numeric_limits<double>::lowest());
  for (const glm::dvec3& p : mesh.positions) low = glm::min(low, p), high = glm::max(high, p);
  const glm::dvec3 origin = (low + high) * 0.5;  // the pack's differs by less than the box
  // The mean over the area: the rims of a pane do not count.
  FaceRounding mean;
  double area = 0;
  for (const glm::uvec3& t : mesh.triangles) {
    const glm::dvec3 &a = mesh.positions[t.x], &b = mesh.positions[t.y], &c = mesh.positions[t.z];
    constexpr double kThird = 1.0 / 3;
    const FaceRounding face = faceRounding({a, b, c}, origin, kThird, kThird);
    const double weight = glm::length(glm::cross(b - a, c - a));
    mean.hit += weight * face.hit, mean.start += weight * face.start, area += weight;
  }
  if (!(area > 0)) return std::nullopt;
  mean = {mean.hit / area, mean.start / area};
  AbsorptionPrecision found{mean.hit, std::expm1(absorption * mean.hit), 0};
  if (inside > 0 && !mesh.openSurface)
    if (const double thickness = meanThickness(mesh); thickness > 0 && thickness <= mean.start)
      found = {mean.start, std::expm1(inside * thickness), thickness};
  if (found.error <= kAbsorptionPrecision) return std::nullopt;
  return found;
}

}  // namespace malus::bake
