// Difference of two images.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "meshprep/base/image.h"

namespace malus::render {

struct ImageDifference {
  double mean = 0;  // absolute difference, over pixels and channels
  double rms = 0;
  double relRms = 0;  // root of the sum of squared differences over that of squared values of the second image
  double max = 0;
  double p999 = 0;             // 99.9 percentile over the pixels of the largest difference of any channel
  std::uint64_t outliers = 0;  // pixels whose largest difference is above the threshold
  std::uint64_t pixels = 0;
  std::uint64_t nonFinite = 0;  // pixels with NaN or infinity in either image; also outliers
};

// Compares the named channels; Y of a grey image is its R, G and B. Throws Error: the sizes differ, or an image lacks a
// channel.
ImageDifference difference(const image::Image& a, const image::Image& b, const std::vector<std::string>& channels,
                           double threshold);

// Absolute difference of R, G and B times gain. Throws as difference() does.
image::Image differenceImage(const image::Image& a, const image::Image& b, double gain);

}  // namespace malus::render
