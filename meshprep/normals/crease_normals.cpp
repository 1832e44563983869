#include "meshprep/normals/crease_normals.h"

#include <cmath>

#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace malus::prep {

namespace {

constexpr double kCosineTolerance = 1e-6;  // an edge of exactly the crease angle is smooth, rounding or not

}  // namespace

NormalCounts addCreaseNormals(Mesh& mesh, double creaseDegrees) {
  const double minCosine = std::cos(glm::radians(creaseDegrees)) - kCosineTolerance;
  return addPieceNormals(mesh, [&](std::uint32_t, std::uint32_t, const glm::dvec3& a, const glm::dvec3& b) {
    return glm::dot(a, b) >= minCosine;
  });
}

}  // namespace malus::prep
