// What a user asks of a picture beside the pack: size, part, depth, filter.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "bake/pack/scene.h"

namespace malus::render {

// A part of the picture, in pixels from the upper left corner.
struct Region {
  std::uint32_t x = 0, y = 0, width = 0, height = 0;
};

// First row of the Mueller matrix of what stands in front of the camera: the recorded intensity is its
// product with the Stokes vector in the camera's frame.
using Analyser = std::array<double, 4>;
inline constexpr Analyser kNoFilter = {1, 0, 0, 0};
// Linear polarizer that passes light along an axis at `degrees` from the picture's x axis, counter-clockwise
// as the photographer sees it: 1/2 (1, cos 2f, sin 2f, 0).
Analyser linearPolarizer(double degrees);

struct View {
  std::uint32_t width = 0;  // of the whole picture
  std::uint32_t height = 0;
  Region region;
  std::uint32_t samples = 1;  // rays per pixel along each axis
  std::uint32_t depth = 0;    // most specular interactions along a path
  Analyser analyser = kNoFilter;
};

// The pack's own view.
View viewOf(const pack::Scene& scene);

}  // namespace malus::render
