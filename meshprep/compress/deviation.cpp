#include "meshprep/compress/deviation.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "meshprep/compress/bounds.h"

namespace malus::compress {

namespace {

constexpr double kAreaTolerance = 1e-12;

double largest(const glm::dvec3& v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); }

double degreesBetween(const glm::dvec3& a, const glm::dvec3& b) {
  return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

// Largest of many angles. Computes the arc tangent only if a comparison of squared tangents cannot exclude the angle.
class LargestAngle {
 public:
  // Returns true if the angle between a and b exceeds all earlier ones.
  bool add(const glm::dvec3& a, const glm::dvec3& b) {
    const glm::dvec3 cross = glm::cross(a, b);
    const double dot = glm::dot(a, b);
    if (dot > 0 && glm::dot(cross, cross) <= tangentSquared_ * dot * dot) return false;
    const double angle = glm::degrees(std::atan2(glm::length(cross), dot));
    if (angle <= degrees_) return false;
    degrees_ = angle;
    tangentSquared_ = dot > 0 ? glm::dot(cross, cross) / (dot * dot) : kNever;
    return true;
  }
  double degrees() const { return degrees_; }

 private:
  static constexpr double kNever = 1e300;
  double degrees_ = 0;
  double tangentSquared_ = 0;
};

// Returns a vector along the normal, scaled so that squares stay in the range of double, or nothing without area.
std::optional<glm::dvec3> faceNormal(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) {
  const double scale = std::max({largest(b - a), largest(c - b), largest(a - c)});
  if (scale == 0) return std::nullopt;
  const glm::dvec3 u = (b - a) / scale, v = (c - a) / scale, w = v - u;
  const glm::dvec3 normal = glm::cross(u, v);
  const double longest = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  if (glm::dot(normal, normal) <= kAreaTolerance * kAreaTolerance * longest * longest) return std::nullopt;
  return normal;
}

double area(std::span<const glm::dvec3> positions, const glm::uvec3& t) {
  return 0.5 * glm::length(glm::cross(positions[t.y] - positions[t.x], positions[t.z] - positions[t.x]));
}

std::optional<glm::dvec3> faceNormal(std::span<const glm::dvec3> positions, const glm::uvec3& t,
                                     double leastCross = 0) {
  if (leastCross > 0 && !(2 * area(positions, t) > leastCross)) return std::nullopt;
  return faceNormal(positions[t.x], positions[t.y], positions[t.z]);
}

}  // namespace

bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { return faceNormal(a, b, c).has_value(); }

Deviation measureDeviation(const MeshView& source, std::span<const glm::dvec3> positions,
                           std::span<const glm::vec3> normals, double leastCross) {
  Deviation deviation;

  // Compare vertices.
  double farthest = 0;
  LargestAngle normalAngle;
  for (std::size_t i = 0; i < positions.size(); ++i)
    farthest = std::max(farthest, glm::distance(positions[i], source.positions[i]));
  for (std::size_t i = 0; i < normals.size(); ++i) normalAngle.add(source.normals[i], normals[i]);

  // Compare the faces that have area.
  const double tangent = std::tan(glm::radians(kDefaultTiltDegrees));
  LargestAngle tilt;
  for (std::size_t i = 0; i < source.triangles.size(); ++i) {
    const std::optional<glm::dvec3> before = faceNormal(source.positions, source.triangles[i]);
    if (!before) continue;
    ++deviation.faces;
    const std::optional<glm::dvec3> after = faceNormal(positions, source.triangles[i], leastCross);
    if (!after) {
      if (deviation.newDegenerate++ == 0) deviation.degenerateFace = static_cast<std::uint32_t>(i);
      deviation.degenerateArea += area(source.positions, source.triangles[i]);
      continue;
    }
    if (tilt.add(*before, *after)) deviation.tiltFace = static_cast<std::uint32_t>(i);
    const glm::dvec3 cross = glm::cross(*before, *after);
    const double dot = glm::dot(*before, *after);
    if (dot > 0 && glm::dot(cross, cross) <= tangent * tangent * dot * dot) continue;
    ++deviation.tilted;
    deviation.tiltedArea += area(source.positions, source.triangles[i]);
    if (dot < 0 && deviation.flipped++ == 0) deviation.flippedFace = static_cast<std::uint32_t>(i);
  }
  deviation.positionMax = farthest;
  deviation.normalMaxDegrees = normalAngle.degrees();
  deviation.tiltMaxDegrees = tilt.degrees();
  return deviation;
}

bool positionsWithin(const MeshView& source, std::span<const glm::dvec3> positions, const DeviationLimits& limits) {
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (glm::distance(positions[i], source.positions[i]) > limits.position) return false;
  const double cosine = std::cos(glm::radians(limits.tiltDegrees));
  for (const glm::uvec3& t : source.triangles) {
    const std::optional<glm::dvec3> before = faceNormal(source.positions, t);
    if (!before) continue;
    const std::optional<glm::dvec3> after = faceNormal(positions, t, limits.leastCross);
    if (!after && !limits.newDegenerate) return false;
    if (!after) continue;
    // Accept clear cases by the cosine, which cannot resolve small angles.
    const double dot = glm::dot(*before, *after);
    const double lengths = std::sqrt(glm::dot(*before, *before) * glm::dot(*after, *after));
    if (dot >= lengths * (cosine + 1e-9)) continue;
    if (degreesBetween(*before, *after) > limits.tiltDegrees) return false;
  }
  return true;
}

bool normalsWithin(const MeshView& source, std::span<const glm::vec3> normals, const DeviationLimits& limits) {
  for (std::size_t i = 0; i < normals.size(); ++i)
    if (degreesBetween(source.normals[i], normals[i]) > limits.normalDegrees) return false;
  return true;
}

}  // namespace malus::compress
