#include "render/viewer/filtered_colours.h"

#include <algorithm>
#include <vector>

namespace malus::viewer {

namespace {

// A colour of one pixel behind the filter. values: its channels.
float filtered(const float* values, std::size_t colour, const render::Analyser& analyser) {
  double sum = 0;
  for (std::size_t s = 0; s < 4; ++s) sum += analyser[s] * static_cast<double>(values[3 + 3 * s + colour]);
  return static_cast<float>(std::max(sum, 0.0));
}

render::RenderResult filter(const ImageRows& image, const render::Analyser& analyser, std::size_t channels) {
  render::RenderResult result;
  result.width = image.width;
  result.height = image.height;
  result.channels = channels;
  const std::size_t count = std::size_t{image.width} * image.height;
  result.pixels.resize(channels * count);
  std::vector<float> copy;
  const float* from = hostValues(*image.store, 0, image.channels * count, copy).data();
  float* to = result.pixels.data();
  const bool hasStokes = image.channels == render::kStokesChannels;
  for (std::size_t i = 0; i < count; ++i, from += image.channels, to += channels) {
    std::copy_n(from, channels, to);
    for (std::size_t c = 0; hasStokes && c < 3; ++c) to[c] = filtered(from, c, analyser);
  }
  return result;
}

}  // namespace

render::RenderResult filteredColours(const ImageRows& image, const render::Analyser& analyser) {
  return filter(image, analyser, render::kColourChannels);
}

render::RenderResult filteredImage(const ImageRows& image, const render::Analyser& analyser) {
  return filter(image, analyser, image.channels);
}

}  // namespace malus::viewer
