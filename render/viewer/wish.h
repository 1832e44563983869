// The images that the window asks the render thread for.
#pragma once

#include <cstdint>
#include <vector>

#include "render/viewer/view_state.h"

namespace malus::viewer {

struct Wish {
  std::uint64_t generation = 0;
  std::uint32_t width = 0, height = 0;  // of the window, in pixels
  ViewState state;
};

// Whether two views need different images: filters, exposure and what is shown do not count, except the filter of a
// side that stores no Stokes vectors.
bool needsRender(const Wish& before, const Wish& after, const std::vector<pack::Effect>& needed);

// Whether methods, effects and sizes are the same, so that only the camera can differ.
bool isSamePreparation(const Wish& before, const Wish& after, const std::vector<pack::Effect>& needed);

}  // namespace malus::viewer
