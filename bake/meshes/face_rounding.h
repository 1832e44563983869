// Rounding of the single-precision renderers at a face, by their own functions (shaders/optics/surface_point.h).
#pragma once

#include <array>

#include <glm/vec3.hpp>

namespace malus::bake {

using Corners = std::array<glm::dvec3, 3>;  // of a face, relative to the scene's origin, metres

struct FaceRounding {
  double hit = 0;    // bound on the error of a hit along the normal, metres
  double start = 0;  // distance from the hit along the normal at which further rays start, metres
};

// At the point with the barycentric coordinates b1 and b2 of the second and third corner. origin: of the mesh, relative
// to the scene's. Zeros for a face without area.
FaceRounding faceRounding(const Corners& face, const glm::dvec3& origin, double b1, double b2);

// Returns the largest distance from the face at which rays start: that at a corner.
double largestStart(const Corners& face, const glm::dvec3& origin);

// Returns a bound on it for all faces between two corners of a box.
double boundStart(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& origin);

}  // namespace malus::bake
