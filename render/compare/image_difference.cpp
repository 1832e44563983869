#include "render/compare/image_difference.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "meshprep/base/error.h"

namespace malus::render {

namespace {

void requireSameSize(const image::Image& a, const image::Image& b) {
  if (a.width != b.width || a.height != b.height)
    throw Error("", "the images differ in size", fmt::format("{} x {}", a.width, a.height),
                fmt::format("{} x {}", b.width, b.height));
}

// Y of a grey image is its red, green and blue.
std::size_t channelIndex(const image::Image& image, const std::string& name) {
  int index = image.channel(name);
  if (index < 0 && (name == "R" || name == "G" || name == "B")) index = image.channel("Y");
  if (index < 0) throw Error("", fmt::format("an image has no channel {}", name), "the channel in both images");
  return static_cast<std::size_t>(index);
}

}  // namespace

ImageDifference difference(const image::Image& a, const image::Image& b, const std::vector<std::string>& channels,
                           double threshold) {
  requireSameSize(a, b);
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (const std::string& name : channels) pairs.emplace_back(channelIndex(a, name), channelIndex(b, name));
  ImageDifference result;
  result.pixels = static_cast<std::uint64_t>(a.width) * static_cast<std::uint64_t>(a.height);
  std::vector<double> largest(result.pixels);
  double sum = 0, squares = 0, values = 0;
  std::uint64_t counted = 0;
  for (std::size_t i = 0; i < result.pixels; ++i) {
    bool finite = true;
    for (const auto& [ca, cb] : pairs) {
      const double x = a.pixels[i * a.channels.size() + ca], y = b.pixels[i * b.channels.size() + cb];
      if (!std::isfinite(x) || !std::isfinite(y)) {
        finite = false;
        continue;
      }
      const double d = std::abs(x - y);
      largest[i] = std::max(largest[i], d);
      sum += d;
      squares += d * d;
      values += y * y;
      ++counted;
    }
    if (!finite) {
      ++result.nonFinite;
      largest[i] = std::numeric_limits<double>::infinity();
    }
    if (largest[i] > threshold) ++result.outliers;
  }
  if (counted > 0) {
    result.mean = sum / static_cast<double>(counted);
    result.rms = std::sqrt(squares / static_cast<double>(counted));
    if (squares > 0) result.relRms = values > 0 ? std::sqrt(squares / values) : std::numeric_limits<double>::infinity();
  }
  if (!largest.empty()) {
    const auto at = static_cast<std::size_t>(0.999 * static_cast<double>(largest.size() - 1));
    std::nth_element(largest.begin(), largest.begin() + static_cast<std::ptrdiff_t>(at), largest.end());
    result.p999 = largest[at];
    result.max = *std::max_element(largest.begin(), largest.end());
  }
  return result;
}

image::Image differenceImage(const image::Image& a, const image::Image& b, double gain) {
  requireSameSize(a, b);
  image::Image result;
  result.width = a.width;
  result.height = a.height;
  result.channels = {"R", "G", "B"};
  result.pixels.resize(static_cast<std::size_t>(a.width) * static_cast<std::size_t>(a.height) * 3);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t ca = channelIndex(a, result.channels[c]), cb = channelIndex(b, result.channels[c]);
    for (std::size_t i = 0; i * 3 < result.pixels.size(); ++i)
      result.pixels[3 * i + c] = static_cast<float>(
          gain * std::abs(double{a.pixels[i * a.channels.size() + ca]} - b.pixels[i * b.channels.size() + cb]));
  }
  return result;
}

}  // namespace malus::render
