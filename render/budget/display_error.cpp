#include "render/budget/display_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace malus::render {

double SquaredError::relRms() const {
  return reference > 0 ? std::sqrt(difference / reference) : std::sqrt(difference);
}

SquaredError& SquaredError::operator+=(const SquaredError& other) {
  difference += other.difference;
  reference += other.reference;
  pixels += other.pixels;
  wrongPixels += other.wrongPixels;
  return *this;
}

SquaredError pixelError(const float* image, const float* reference, double exposureEv) {
  const double white = std::exp2(-exposureEv);
  SquaredError error;
  error.pixels = 1;
  for (std::size_t c = 0; c < 3; ++c) {
    if (!std::isfinite(image[c])) {
      error.difference = std::numeric_limits<double>::infinity();
      error.wrongPixels = 1;
      continue;
    }
    const double truth = std::min<double>(reference[c], white), d = std::min<double>(image[c], white) - truth;
    error.difference += d * d;
    error.reference += truth * truth;
    if (std::abs(d) > 0.01 * std::abs(truth)) error.wrongPixels = 1;
  }
  return error;
}

SquaredError displayError(const RenderResult& image, const RenderResult& reference, double exposureEv) {
  SquaredError sum;
  const std::size_t count = std::size_t{image.width} * image.height;
  for (std::size_t i = 0; i < count; ++i)
    sum += pixelError(image.pixels.data() + i * image.channels, reference.pixels.data() + i * reference.channels,
                      exposureEv);
  return sum;
}

}  // namespace malus::render
