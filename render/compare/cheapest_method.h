// Which method is the cheapest that is good enough for a pack: every method is rendered small against the
// reference, and what was found is kept in the user's cache folder by the hash of pack and view.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "bake/pack/reader.h"
#include "render/renderer.h"
#include "render/scene/render_parameters.h"

namespace malus::render {

struct MethodEstimate {
  std::string method;
  double relRms = 0;    // against the reference, of the small picture
  double medianMs = 0;  // of its interleaved rounds
};

// Every method's error and time for a pack with this depth and filter, at a width of 256 pixels, from the cache if it
// is there. renderer: made from pack.scene. threads: of the reference, 0 for all. Throws what rendering throws.
std::vector<MethodEstimate> estimateMethods(const pack::Pack& pack, const RenderParameters& parameters,
                                            Renderer& renderer, unsigned threads,
                                            const std::function<void(std::string_view)>& progress);

// The fastest with relRms <= maxError. Throws Error, naming the best there is, where there is none.
const MethodEstimate& cheapestUnder(const std::vector<MethodEstimate>& estimates, double maxError);

}  // namespace malus::render
