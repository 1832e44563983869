// The rays of an image, recorded by the single-ray tracers with checks, for `malus bench rays`.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <map>
#include <vector>

#include <glm/vec3.hpp>

namespace malus::embree {

// bounce: interactions before the ray; 0 for camera rays and for the shadow rays of what those meet.
struct RayClass {
  int bounce = 0;
  bool shadow = false;
  auto operator<=>(const RayClass&) const = default;  // NOLINT(modernize-use-nullptr): as in vulkan/variant.h
};

// Rays as structure of arrays, in the order in which they were traced. A shadow ray ends at direction times 1.
struct RayArrays {
  std::array<std::vector<float>, 3> origin, direction;

  std::size_t size() const { return origin[0].size(); }
  void add(const glm::vec3& o, const glm::vec3& d) {
    for (int i = 0; i < 3; ++i) {
      origin[static_cast<std::size_t>(i)].push_back(o[i]);
      direction[static_cast<std::size_t>(i)].push_back(d[i]);
    }
  }
  bool operator==(const RayArrays&) const = default;
};

using RayLog = std::map<RayClass, RayArrays>;

inline std::size_t countRays(const RayLog& log) {
  std::size_t sum = 0;
  for (const auto& [kind, rays] : log) sum += rays.size();
  return sum;
}

// Appends the rays of another part of the image.
inline void append(RayLog& log, const RayLog& part) {
  for (const auto& [kind, rays] : part)
    for (std::size_t i = 0; i < 3; ++i) {
      RayArrays& all = log[kind];
      all.origin[i].insert(all.origin[i].end(), rays.origin[i].begin(), rays.origin[i].end());
      all.direction[i].insert(all.direction[i].end(), rays.direction[i].begin(), rays.direction[i].end());
    }
}

}  // namespace malus::embree
