// How far two pictures are apart.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

struct ImageDifference {
  double mean = 0;  // of the absolute differences, over pixels and channels
  double rms = 0;
  double max = 0;
  double p999 = 0;             // 99.9 percentile, over pixels, of the largest difference among the channels
  std::uint64_t outliers = 0;  // pixels whose largest difference is over the threshold
  std::uint64_t pixels = 0;
  std::uint64_t nonFinite = 0;  // pixels with NaN or infinity in one picture only, or in both; also outliers
};

// Of the named channels; each must be in both. Throws Error: sizes differ, a channel is missing.
ImageDifference difference(const image::Image& a, const image::Image& b, const std::vector<std::string>& channels,
                           double threshold);

// Absolute difference of R, G, B times gain, as a picture.
image::Image differenceImage(const image::Image& a, const image::Image& b, double gain);

}  // namespace malus::render
