// Measures the deviation of a rounded mesh from its source: positions, normals and the tilt of faces.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <glm/vec3.hpp>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Returns true if the height above the longest edge exceeds 1e-12 times that edge: a few thousand rounding errors of a
// cross product in double. Cleaning drops faces by the same rule (clean/degenerate_faces.h). Faces without area in the
// source are exempt from all limits.
bool hasArea(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c);

// Largest allowed deviations.
struct DeviationLimits {
  double position = std::numeric_limits<double>::infinity();  // metres
  double normalDegrees = 180;
  double tiltDegrees = 180;
  bool newDegenerate = true;  // allows faces to lose their area
  double leastCross = 0;      // faces below it have lost their area: twice the area, square metres
};

// Smallest doubled area of a face whose normal the renderers compute: its square is above kNegligible
// (shaders/optics/vector.h).
inline constexpr double kLeastFloatCross = 0x1p-61;

// Compares vertices and faces of equal index. positions: one per vertex of source. normals: one per vertex, or empty if
// source has none. leastCross: as in DeviationLimits.
Deviation measureDeviation(const MeshView& source, std::span<const glm::dvec3> positions,
                           std::span<const glm::vec3> normals, double leastCross = 0);

// Returns true if all positions and faces are within the limits. Stops at the first that is not.
bool positionsWithin(const MeshView& source, std::span<const glm::dvec3> positions, const DeviationLimits& limits);

// Returns true if all normals are within the limits.
bool normalsWithin(const MeshView& source, std::span<const glm::vec3> normals, const DeviationLimits& limits);

}  // namespace malus::compress
