// The error of an image against another of the same view: of a method against the exact method on the same renderer, or
// of a renderer's precision against the double-precision reference.
#pragma once

#include <vector>

#include "render/scene/render_result.h"

namespace malus::render {

struct ImageError {
  double meanAbs = 0;            // mean absolute difference over pixels and colours, in radiance
  double maxAbs = 0;             // largest absolute difference, in radiance
  double relRms = 0;             // root of the sum of squared differences over the sum of squared reference values
  double shareOver1Percent = 0;  // of pixels that have a colour with an error above 1 % of the reference's value, or
                                 // above 1 % of a thousandth of its mean if that is more
  double perceptual = 0;         // mean FLIP (flip.h), 0 to 1
  double energyRatio = 0;        // sum over the image divided by the sum over the reference
};

// Compares the colours behind the filter. exposureEv: of the display, in stops, for FLIP. A non-finite value in the
// image makes meanAbs, maxAbs and relRms infinite. Throws Error if the sizes differ.
ImageError imageError(const RenderResult& image, const RenderResult& reference, double exposureEv);

// r, g, b of every pixel.
std::vector<float> colours(const RenderResult& image);

// Largest absolute difference of two lists of equal length.
double largestDifference(const std::vector<float>& a, const std::vector<float>& b);

}  // namespace malus::render
