// Rounding of positions to grids and of normals to octahedral coordinates, as encoding does it.
//
// Source of the rounding of normals: Draco 1.5.5, normal_compression_utils.h.
#pragma once

#include <bit>
#include <cstdint>
#include <span>
#include <vector>

#include <glm/vec3.hpp>

#include "meshprep/compress/draco_mesh.h"

namespace malus::compress {

// Rounds to the nearest multiple of a power of two, ties to even.
glm::dvec3 roundToStep(const glm::dvec3& p, double step);
std::vector<glm::dvec3> roundPositions(std::span<const glm::dvec3> positions, double step);

// Rounds to the nearest float in the range of normal floats. A pair of conversions to float and back is not used: GCC
// 12 removes it where it vectorizes.
glm::dvec3 roundToFloat(const glm::dvec3& p);
// The 29 bits that a double has below the mantissa of a float are 0.
inline bool isFloat(const glm::dvec3& p) {
  constexpr std::uint64_t kLowBits29 = (std::uint64_t{1} << 29) - 1;
  return ((std::bit_cast<std::uint64_t>(p.x) | std::bit_cast<std::uint64_t>(p.y) | std::bit_cast<std::uint64_t>(p.z)) &
          kLowBits29) == 0;
}

// Bounding box of positions that are not empty, and its largest extent.
struct Extent {
  glm::dvec3 low, high;
  double largest() const;
  double farthest() const;  // largest absolute coordinate
};
Extent findExtent(std::span<const glm::dvec3> positions);

// Returns the exponent of the smallest power of two with which the rounded positions span at most 2^bits - 1 steps, at
// most kMaxSteps from zero. The extent is that of the positions, which must be finite.
int stepExponent(const Extent& extent, int bits);

// Rounds unit normals to octahedral coordinates with `bits` bits (kMinNormalBits to kMaxNormalBits), and normalizes.
std::vector<glm::vec3> roundNormals(std::span<const glm::vec3> normals, int bits);

}  // namespace malus::compress
