// The error that --max-error bounds: relative RMS against the complete image, with radiance clamped at the display's
// white, so that a sun in view does not outweigh the rest.
#pragma once

#include <cstddef>
#include <vector>

#include "render/scene/render_result.h"

namespace malus::render {

// Sums over pixels and colours of squared differences and of squared reference values, and the pixels.
struct SquaredError {
  double difference = 0, reference = 0;
  std::size_t pixels = 0, wrongPixels = 0;  // wrong: a colour with an error above 1 % of the reference's value
  double relRms() const;
  SquaredError& operator+=(const SquaredError& other);
};

// Of one pixel. exposureEv: values of 2^-exposureEv are the display's white. A value that is not finite is infinitely
// wrong.
SquaredError pixelError(const float* image, const float* reference, double exposureEv);

// Of a whole image. The sizes must be equal.
SquaredError displayError(const RenderResult& image, const RenderResult& reference, double exposureEv);

}  // namespace malus::render
