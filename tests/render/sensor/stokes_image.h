// Images with Stokes channels that functions define, for the tests of sensors.
#pragma once

#include <array>
#include <string>

#include "meshprep/base/image.h"

namespace malus::render {

// function(x, y, colour) returns S0, S1, S2 of a pixel.
template <class Function>
image::Image stokesImage(int width, int height, const Function& function) {
  image::Image image;
  image.width = width;
  image.height = height;
  for (const char* s : {"S0", "S1", "S2", "S3"})
    for (const char* c : {"R", "G", "B"}) image.channels.push_back(std::string(s) + "." + c);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::array<std::array<double, 3>, 3> colours{};
      for (int c = 0; c < 3; ++c) colours[static_cast<std::size_t>(c)] = function(x, y, c);
      for (std::size_t s = 0; s < 4; ++s)
        for (std::size_t c = 0; c < 3; ++c) image.pixels.push_back(s < 3 ? static_cast<float>(colours[c][s]) : 0.0f);
    }
  return image;
}

// Unpolarized light of one radiance.
inline image::Image unpolarized(int width, int height, double radiance) {
  return stokesImage(width, height, [&](int, int, int) { return std::array<double, 3>{radiance, 0, 0}; });
}

}  // namespace malus::render
