// Patches of interfaces, and the angles at which light can travel from one to another.
#pragma once

#include <cstdint>
#include <vector>

#include <glm/vec3.hpp>

#include "bake/pack/scene.h"

namespace malus::bake {

// Absolute cosines of the angle of incidence; empty: low > high.
struct CosineRange {
  double low = 0, high = 1;
  bool isEmpty() const { return low > high; }
};

// A face of an interface or, of a scene with more than kMostPatches faces, a whole placement.
struct InterfacePatch {
  std::uint32_t material = 0;
  std::vector<glm::dvec3> hull;  // points whose convex hull contains it; empty: anywhere
  glm::dvec3 axis{0, 0, 1};      // of the cone of its normals
  double spread = 0;             // half angle of that cone in radians; pi: any normal
  bool isFlat = false;           // one face with its own normal
};
inline constexpr std::size_t kMostPatches = 300;
// One patch per material without bounds if the placements are more than kMostPatches, too.
std::vector<InterfacePatch> interfacePatches(const pack::Scene& scene);

// Angles of incidence on a patch of straight rays from the convex hull of some points; none: from anywhere. A range
// that contains every possible angle. Empty if the patch is flat and all points are within `flatness` (metres) of its
// plane.
CosineRange incidence(const std::vector<glm::dvec3>& from, const InterfacePatch& to, double flatness);

}  // namespace malus::bake
