#include "render/vulkan/launches.h"

#include <algorithm>
#include <cassert>

namespace malus::vulkan {

namespace {

// Largest ratio of a launch to the one before. Launches shorter than kLaunchMs / kMaxGrowth consist largely of constant
// costs: their time is a poor estimate for a larger one.
constexpr double kMaxGrowth = 8;

// Largest expected ratio of the cost of a pixel to the mean of an image.
constexpr double kMaxContrast = 32;

}  // namespace

void LaunchSize::beginImage() {
  if (worstMsPerRay_ > 0)
    mostRays_ = kLaunchMs / std::min(worstMsPerRay_, kMaxContrast * imageMs_ / imageRays_);
  else
    mostRays_ *= kMaxGrowth;
  worstMsPerRay_ = imageMs_ = imageRays_ = 0;
  rays_ = std::min(rays_, mostRays_);
}

std::uint64_t LaunchSize::pixels(std::uint64_t perPixel) const {
  return std::max<std::uint64_t>(1, static_cast<std::uint64_t>(rays_ / static_cast<double>(perPixel)));
}

void LaunchSize::add(std::uint64_t pixels, std::uint64_t perPixel, double ms) {
  const double rays = static_cast<double>(pixels) * static_cast<double>(perPixel);
  imageMs_ += ms;
  imageRays_ += rays;
  if (ms < kLaunchMs / kMaxGrowth) {
    rays_ = std::max(rays_, kMaxGrowth * rays);
  } else {
    rays_ = rays * kLaunchMs / ms;
    worstMsPerRay_ = std::max(worstMsPerRay_, ms / rays);
  }
  rays_ = std::min({rays_, mostRays_, 0x1p53});
}

render::Region LaunchRegions::next(std::uint64_t pixels) {
  assert(pixels > 0 && !isDone());
  const std::uint32_t left = region_.width - column_;
  render::Region part{region_.x + column_, region_.y + row_, left, 1};
  if (column_ > 0 || pixels < region_.width) {
    part.width = static_cast<std::uint32_t>(std::min<std::uint64_t>(pixels, left));
    column_ += part.width;
    if (column_ == region_.width) column_ = 0, ++row_;
  } else {
    part.height = static_cast<std::uint32_t>(std::min<std::uint64_t>(pixels / region_.width, region_.height - row_));
    row_ += part.height;
  }
  return part;
}

}  // namespace malus::vulkan
