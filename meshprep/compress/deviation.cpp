#include "meshprep/compress/deviation.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <vector>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "meshprep/base/parallel_blocks.h"
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

// Comparison of faces without division and roots, which decides most of them.
class ClearFace {
 public:
  ClearFace(std::span<const glm::dvec3> positions, const glm::uvec3& t) {
    const glm::dvec3& a = positions[t.x];
    const glm::dvec3 u = positions[t.y] - a, v = positions[t.z] - a, w = v - u;
    cross_ = glm::cross(u, v);
    squared_ = glm::dot(cross_, cross_);
    longest_ = std::max({glm::dot(u, u), glm::dot(v, v), glm::dot(w, w)});
  }

  // Returns true if the doubled area certainly exceeds leastCross and the direction of the normal has an error below
  // 1e-12, because the height is not small; and if products of four lengths are in the range of double.
  bool isClear(double leastCross = 0) const {
    constexpr double kLeastHeight = 1e-3;  // of the longest edge
    constexpr double kLeast = 1e-140, kMost = 1e140;
    return squared_ > kLeastHeight * kLeastHeight * longest_ * longest_ && squared_ > 2 * leastCross * leastCross &&
           squared_ > kLeast && squared_ < kMost;
  }

  // Squared tangent of the angle between the normals, which are clear; infinity if it is a right angle or more.
  double tangentSquared(const ClearFace& other) const {
    const double dot = glm::dot(cross_, other.cross_);
    if (!(dot > 0)) return std::numeric_limits<double>::infinity();
    const glm::dvec3 cross = glm::cross(cross_, other.cross_);
    return glm::dot(cross, cross) / (dot * dot);
  }

 private:
  glm::dvec3 cross_;
  double squared_, longest_;
};

// Squared tangents below this share of a limit are certainly below it, if the limit is at least kLeastTangentSquared:
// the errors of clear normals are below 1e-12.
constexpr double kCertain = 1 - 1e-6, kLeastTangentSquared = 1e-10;

// Returns the faces in order without those that certainly have area and are tilted by less than the default and less
// than an earlier face.
std::vector<std::uint32_t> facesToMeasure(const MeshView& source, std::span<const glm::dvec3> positions,
                                          double leastCross) {
  const double tangent = std::tan(glm::radians(kDefaultTiltDegrees));
  return collectBlocks<std::uint32_t>(
      source.triangles.size(), [&](std::size_t first, std::size_t last, std::vector<std::uint32_t>& list) {
        double most = 0;  // squared tangent, of the faces in the list
        for (std::size_t i = first; i < last; ++i) {
          const ClearFace before(source.positions, source.triangles[i]), after(positions, source.triangles[i]);
          if (before.isClear() && after.isClear(leastCross)) {
            const double tilt = before.tangentSquared(after);
            if (most >= kLeastTangentSquared && tilt <= kCertain * most) continue;
            most = std::min(std::max(most, tilt), tangent * tangent);
          }
          list.push_back(static_cast<std::uint32_t>(i));
        }
      });
}

double farthest(std::span<const glm::dvec3> a, std::span<const glm::dvec3> b) {
  double squared = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const glm::dvec3 d = a[i] - b[i];
    squared = std::max(squared, glm::dot(d, d));
  }
  return std::sqrt(squared);
}

// Whether a face is within the limits.
bool faceWithin(const MeshView& source, std::span<const glm::dvec3> positions, const glm::uvec3& t,
                const DeviationLimits& limits, double cosine) {
  const std::optional<glm::dvec3> before = faceNormal(source.positions, t);
  if (!before) return true;
  const std::optional<glm::dvec3> after = faceNormal(positions, t, limits.leastCross);
  if (!after) return limits.newDegenerate;
  // Accept clear cases by the cosine, which cannot resolve small angles.
  const double dot = glm::dot(*before, *after);
  const double lengths = std::sqrt(glm::dot(*before, *before) * glm::dot(*after, *after));
  return dot >= lengths * (cosine + 1e-9) || degreesBetween(*before, *after) <= limits.tiltDegrees;
}

}  // namespace

bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c) { return faceNormal(a, b, c).has_value(); }

Deviation measureDeviation(const MeshView& source, std::span<const glm::dvec3> positions,
                           std::span<const glm::vec3> normals, double leastCross) {
  Deviation deviation;

  // Compare vertices.
  LargestAngle normalAngle;
  for (std::size_t i = 0; i < normals.size(); ++i) normalAngle.add(source.normals[i], normals[i]);

  // Compare the faces that have area.
  const double tangent = std::tan(glm::radians(kDefaultTiltDegrees));
  LargestAngle tilt;
  const std::vector<std::uint32_t> faces = facesToMeasure(source, positions, leastCross);
  deviation.faces = source.triangles.size() - faces.size();
  for (const std::uint32_t i : faces) {
    const std::optional<glm::dvec3> before = faceNormal(source.positions, source.triangles[i]);
    if (!before) continue;
    ++deviation.faces;
    const std::optional<glm::dvec3> after = faceNormal(positions, source.triangles[i], leastCross);
    if (!after) {
      if (deviation.newDegenerate++ == 0) deviation.degenerateFace = i;
      deviation.degenerateArea += area(source.positions, source.triangles[i]);
      continue;
    }
    if (tilt.add(*before, *after)) deviation.tiltFace = i;
    const glm::dvec3 cross = glm::cross(*before, *after);
    const double dot = glm::dot(*before, *after);
    if (dot > 0 && glm::dot(cross, cross) <= tangent * tangent * dot * dot) continue;
    ++deviation.tilted;
    deviation.tiltedArea += area(source.positions, source.triangles[i]);
    if (dot < 0 && deviation.flipped++ == 0) deviation.flippedFace = i;
  }
  deviation.positionMax = farthest(positions, source.positions);
  deviation.normalMaxDegrees = normalAngle.degrees();
  deviation.tiltMaxDegrees = tilt.degrees();
  return deviation;
}

bool positionsWithin(const MeshView& source, std::span<const glm::dvec3> positions, const DeviationLimits& limits) {
  if (std::isfinite(limits.position) && farthest(positions, source.positions) > limits.position) return false;
  constexpr double kMostQuickDegrees = 45;
  const double cosine = std::cos(glm::radians(limits.tiltDegrees)),
               tangent = std::tan(glm::radians(std::min(limits.tiltDegrees, kMostQuickDegrees))),
               certain = kCertain * tangent * tangent;
  return allNumbers(source.triangles.size(), [&](std::size_t i) {
    const glm::uvec3& t = source.triangles[i];
    const ClearFace before(source.positions, t), after(positions, t);
    return (certain >= kLeastTangentSquared && before.isClear() && after.isClear(limits.leastCross) &&
            before.tangentSquared(after) <= certain) ||
           faceWithin(source, positions, t, limits, cosine);
  });
}

bool normalsWithin(const MeshView& source, std::span<const glm::vec3> normals, const DeviationLimits& limits) {
  const double cosine = std::cos(glm::radians(limits.normalDegrees));
  return allNumbers(normals.size(), [&](std::size_t i) {
    // Accept clear cases by the cosine, as faces.
    const glm::dvec3 a(source.normals[i]), b(normals[i]);
    const double lengths = std::sqrt(glm::dot(a, a) * glm::dot(b, b));
    return glm::dot(a, b) >= lengths * (cosine + 1e-9) || degreesBetween(a, b) <= limits.normalDegrees;
  });
}

}  // namespace malus::compress
