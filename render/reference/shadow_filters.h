// Surfaces on the way from a light to a hit.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "render/reference/hit.h"
#include "render/reference/queries.h"

namespace malus::reference {

// Most thin surfaces that light passes on a way; one more blocks it.
inline constexpr int kMostFilters = 8;

// Mueller matrix of the surfaces on a way, per colour, in the canonical frame of the shadow ray.
using WayFilter = std::array<dmat4, 3>;

// Visits the polarizing elements and thin panes on a way, the nearest to the hit first, and multiplies their matrices
// in the order in which the light, which comes from the other end, meets them. Returns the surface that blocks; a mesh
// of Intersection::kMiss: none. rays: number of the rays that were traced.
embree::Intersection findBlocker(const SceneAccess& access, const ShadowRay& way, WayFilter& filter,
                                 std::uint64_t& rays);

// The same for all ways: visible is 1 or 0, and filters has a matrix per way.
void passAllFilters(const SceneAccess& access, std::span<const ShadowRay> ways, std::vector<std::uint8_t>& visible,
                    std::vector<WayFilter>& filters, std::uint64_t& rays);

// The matrix times light in the canonical frame of the shadow ray.
inline Light operator*(const WayFilter& filter, const Light& light) {
  return {filter[0] * light[0], filter[1] * light[1], filter[2] * light[2]};
}

}  // namespace malus::reference
