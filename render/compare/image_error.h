// How wrong a method's picture is, against the reference of the same view.
#pragma once

#include "render/scene/render_result.h"

namespace malus::render {

struct ImageError {
  double meanAbs = 0;  // over pixels and colours, in radiance
  double maxAbs = 0;
  double relRms = 0;             // root of the sum of squared differences over the sum of squared reference values
  double shareOver1Percent = 0;  // of pixels with a colour off by more than 1 % of the reference's, or of a
                                 // thousandth of its mean where that is more
  double perceptual = 0;         // mean FLIP (flip.h), 0 to 1: what a person sees who flips between them
  double energyRatio = 0;        // sum over the picture against the reference's
};

// Colours behind the filter. exposureEv: of the display, for FLIP. A non-finite value in the
// picture makes meanAbs, maxAbs and relRms infinite. Throws Error where the sizes differ.
ImageError imageError(const RenderResult& picture, const RenderResult& reference, double exposureEv);

}  // namespace malus::render
