#include "meshprep/compress/grid_rounding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include <draco/compression/attributes/normal_compression_utils.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

namespace malus::compress {

namespace {

constexpr std::size_t kGrain = 4096;  // values per task

}  // namespace

glm::dvec3 roundToStep(const glm::dvec3& p, double step) {
  return {std::nearbyint(p.x / step) * step, std::nearbyint(p.y / step) * step, std::nearbyint(p.z / step) * step};
}

std::vector<glm::dvec3> roundPositions(std::span<const glm::dvec3> positions, double step) {
  std::vector<glm::dvec3> rounded(positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, rounded.size(), kGrain),
                    [&](const tbb::blocked_range<std::size_t>& range) {
                      for (std::size_t i = range.begin(); i < range.end(); ++i)
                        rounded[i] = roundToStep(positions[i], step);
                    });
  return rounded;
}

glm::dvec3 roundToFloat(const glm::dvec3& p) {
  constexpr int kFractionBits = 23;
  glm::dvec3 rounded(0);
  for (int axis = 0; axis < 3; ++axis) {
    if (p[axis] == 0) continue;
    const double step = std::ldexp(1.0, std::ilogb(p[axis]) - kFractionBits);
    rounded[axis] = std::nearbyint(p[axis] / step) * step;
  }
  return rounded;
}

double Extent::largest() const { return std::max({high.x - low.x, high.y - low.y, high.z - low.z}); }

double Extent::farthest() const {
  const glm::dvec3 most = glm::max(glm::abs(low), glm::abs(high));
  return std::max({most.x, most.y, most.z});
}

Extent findExtent(std::span<const glm::dvec3> positions) {
  Extent extent{positions.front(), positions.front()};
  for (const glm::dvec3& p : positions) {
    extent.low = glm::min(extent.low, p);
    extent.high = glm::max(extent.high, p);
  }
  return extent;
}

int stepExponent(const Extent& extent, int bits) {
  const double largest = extent.largest(), farthest = extent.farthest();
  if (farthest == 0) return 0;
  // One exponent below the quotient of extent and steps, or the least that kMaxSteps permits; then raise it until it
  // suffices.
  int exponent = std::ilogb(farthest) - 51;
  if (largest > 0) exponent = std::max(exponent, std::ilogb(largest) - bits - 1);
  const double most = std::ldexp(1.0, bits) - 1;
  for (;; ++exponent) {
    const double step = std::ldexp(1.0, exponent);
    const glm::dvec3 span = (roundToStep(extent.high, step) - roundToStep(extent.low, step)) / step;
    if (std::max({span.x, span.y, span.z}) <= most) return exponent;
  }
}

std::vector<glm::vec3> roundNormals(std::span<const glm::vec3> normals, int bits) {
  std::vector<glm::vec3> rounded(normals.size());
  const auto roundRange = [&](const tbb::blocked_range<std::size_t>& range) {
    draco::OctahedronToolBox octahedron;
    octahedron.SetQuantizationBits(bits);
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const std::array<float, 3> normal{normals[i].x, normals[i].y, normals[i].z};
      std::array<float, 3> decoded{};
      std::int32_t s = 0, t = 0;
      octahedron.FloatVectorToQuantizedOctahedralCoords(normal.data(), &s, &t);
      octahedron.QuantizedOctahedralCoordsToUnitVector(s, t, decoded.data());
      const glm::vec3 unit(decoded[0], decoded[1], decoded[2]);
      rounded[i] = unit / glm::length(unit);  // normalize as decode() does
    }
  };
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, normals.size(), kGrain), roundRange);
  return rounded;
}

}  // namespace malus::compress
