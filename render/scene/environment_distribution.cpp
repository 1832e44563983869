#include "render/scene/environment_distribution.h"

#include <cstddef>
#include <span>

#include "shaders/optics/optics.h"

namespace malus::render {

namespace {

// Radiance of the 3 x 3 texels that bilinear interpolation reads within a texel, with their mean weights.
double texelRadiance(const pack::Environment& e, std::size_t column, std::size_t row) {
  constexpr double kWeights[3] = {1.0 / 8, 6.0 / 8, 1.0 / 8};
  double sum = 0;
  for (std::size_t j = 0; j < 3; ++j)
    for (std::size_t i = 0; i < 3; ++i) {
      const glm::vec3& t = e.texels[(row + j) * (e.size + 2) + column + i];
      sum += kWeights[i] * kWeights[j] * (static_cast<double>(t.x) + t.y + t.z);
    }
  return sum;
}

// Writes the cumulative distribution of weights; that of equal ones if all are 0. Returns the sum.
double writeDistribution(std::span<const double> weights, float* out) {
  double sum = 0;
  for (const double w : weights) sum += w;
  double part = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    out[i] = static_cast<float>(sum > 0 ? part / sum : static_cast<double>(i) / static_cast<double>(weights.size()));
    part += weights[i];
  }
  out[weights.size()] = 1;
  return sum;
}

}  // namespace

std::vector<float> environmentDistributions(const pack::Environment& e) {
  const std::size_t size = e.size;
  if (size == 0) return {};
  std::vector<float> result((size + 1) * (size + 1));
  std::vector<double> rows(size), weights(size);
  for (std::size_t y = 0; y < size; ++y) {
    for (std::size_t x = 0; x < size; ++x) {
      const double u = (static_cast<double>(x) + 0.5) / e.size, v = (static_cast<double>(y) + 0.5) / e.size;
      weights[x] = texelRadiance(e, x, y) * f64::octahedralSolidAngle(f64::directionFromOctahedral(u, v));
    }
    rows[y] = writeDistribution(weights, result.data() + (y + 1) * (size + 1));
  }
  writeDistribution(rows, result.data());
  return result;
}

}  // namespace malus::render
