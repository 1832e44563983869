// The cheapest method within an error bound on a pack. Every method renders a small image that is compared with that of
// the exact method on the same renderer, so that the choice does not depend on the renderer's precision; the results
// are cached in the user's cache folder by the hash of pack and parameters.
#pragma once

#include <string>
#include <vector>

#include "bake/pack/reader.h"
#include "render/progress.h"
#include "render/renderer.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

struct MethodEstimate {
  std::string method;
  double relRms = 0;           // of the small image, against the exact method (ImageError::relRms)
  double medianMs = 0;         // of interleaved rounds
  double precisionRelRms = 0;  // of the exact method on this renderer, against the double-precision reference
};

// Measures error and time of every method on a pack with this depth and filter, at a width of 256 pixels, or reads them
// from the cache. Leaves out methods that the device cannot render by. renderer: made from pack.scene. threads: of the
// reference, 0 for all. Throws Error if no method renders.
std::vector<MethodEstimate> estimateMethods(const pack::Pack& pack, const RenderParameters& parameters,
                                            Renderer& renderer, unsigned threads, const Progress& progress);

// The fastest with relRms <= maxError. Throws Error, naming the most accurate, if there is none.
const MethodEstimate& cheapestUnder(const std::vector<MethodEstimate>& estimates, double maxError);

}  // namespace malus::render
