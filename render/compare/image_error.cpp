#include "render/compare/image_error.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"
#include "render/compare/flip.h"

namespace malus::render {

ImageError imageError(const RenderResult& image, const RenderResult& reference, double exposureEv) {
  if (image.width != reference.width || image.height != reference.height)
    throw Error("", "the images differ in size", fmt::format("{} x {}", reference.width, reference.height),
                fmt::format("{} x {}", image.width, image.height));
  const std::size_t count = std::size_t{image.width} * image.height;
  double total = 0;
  for (std::size_t i = 0; i < count; ++i)
    for (std::size_t c = 0; c < 3; ++c) total += reference.pixels[i * reference.channels + c];
  const double floor = 1e-3 * total / (3 * static_cast<double>(count));

  ImageError error;
  double sum = 0, squares = 0, referenceSquares = 0, energy = 0;
  std::size_t wrong = 0;
  for (std::size_t i = 0; i < count; ++i) {
    bool isWrong = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const double truth = reference.pixels[i * reference.channels + c], value = image.pixels[i * image.channels + c];
      const double d = std::isfinite(value) ? std::abs(value - truth) : std::numeric_limits<double>::infinity();
      sum += d;
      squares += d * d;
      referenceSquares += truth * truth;
      energy += value;
      error.maxAbs = std::max(error.maxAbs, d);
      isWrong = isWrong || d > 0.01 * std::max(std::abs(truth), floor);
    }
    if (isWrong) ++wrong;
  }
  error.meanAbs = sum / (3 * static_cast<double>(count));
  error.relRms = referenceSquares > 0 ? std::sqrt(squares / referenceSquares) : std::sqrt(squares);
  error.shareOver1Percent = static_cast<double>(wrong) / static_cast<double>(count);
  error.energyRatio = total > 0 ? energy / total : (energy == 0 ? 1 : std::numeric_limits<double>::infinity());
  error.perceptual = meanFlip(image, reference, exposureEv);
  return error;
}

std::vector<float> colours(const RenderResult& image) {
  std::vector<float> rgb;
  rgb.reserve(kColourChannels * image.width * image.height);
  for (std::size_t i = 0; i < image.pixels.size(); i += image.channels)
    rgb.insert(rgb.end(), {image.pixels[i], image.pixels[i + 1], image.pixels[i + 2]});
  return rgb;
}

double largestDifference(const std::vector<float>& a, const std::vector<float>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, static_cast<double>(std::abs(a[i] - b[i])));
  return largest;
}

}  // namespace malus::render
