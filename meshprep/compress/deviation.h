// How far a mesh that was rounded is off its source: places, normals, and the tilt of faces.
#pragma once

#include <cstdint>
#include <limits>
#include <span>

#include <glm/vec3.hpp>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// A face has area where the height above its longest edge is over 1e-12 of that edge: a few thousand roundings of
// a cross product in double, the rule by which cleaning drops faces. Faces without area in the source are exempt.
bool hasArea(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c);

// What is allowed.
struct DeviationLimits {
  double position = std::numeric_limits<double>::infinity();  // in the unit of positions
  double normalDegrees = 180;
  double tiltDegrees = 180;
  bool newDegenerate = true;  // faces may lose their area
};

// Compares vertex by vertex and face by face; the vertices are in one order. `normals` are both empty, or one a vertex.
Deviation deviationOf(const MeshView& source, std::span<const glm::vec3> positions, std::span<const glm::vec3> normals);

// Whether positions and the faces between them keep the limits; stops at the first that does not.
bool positionsKeep(const MeshView& source, std::span<const glm::vec3> positions, const DeviationLimits& limits);

// Whether normals keep the limits.
bool normalsKeep(const MeshView& source, std::span<const glm::vec3> normals, const DeviationLimits& limits);

// The same for what was measured.
bool keeps(const Deviation& deviation, const DeviationLimits& limits);

}  // namespace malus::compress
