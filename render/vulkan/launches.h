// Launches: the parts of an image that are submitted one after another, so that no submission occupies the device for
// long. Desktop systems reset a device that does not answer for one to two seconds.
#pragma once

#include <cstdint>
#include <limits>

#include "render/scene/render_parameters.h"

namespace malus::vulkan {

// Time that a launch is meant to take [ms]. A launch takes longer if its pixels cost more than those measured before:
// ten times the cost leads to 0.5 s.
inline constexpr double kLaunchMs = 50;

// The size of the next launch, by the times of those before. One object serves the images of one view by one pipeline.
class LaunchSize {
 public:
  // Starts an image. Its pixels are expected to cost as much as the most expensive ones of the image before, but at
  // most 32 times the mean: one delayed small launch must not make all later ones small.
  void beginImage();

  // Pixels of the next launch, at least 1. perPixel: camera rays per pixel.
  std::uint64_t pixels(std::uint64_t perPixel) const;

  // Reports the time of a launch.
  void add(std::uint64_t pixels, std::uint64_t perPixel, double ms);

 private:
  double rays_ = 256;                                          // camera rays of the next launch
  double mostRays_ = std::numeric_limits<double>::infinity();  // limit by the image before
  double worstMsPerRay_ = 0;                                   // of this image's launches; 0: all were short
  double imageMs_ = 0, imageRays_ = 0;                         // sums of this image
};

// Divides a region into launches: whole rows or parts of one row, in the order of the image.
class LaunchRegions {
 public:
  explicit LaunchRegions(const render::Region& region) : region_(region) {}

  bool isDone() const { return row_ == region_.height; }
  // Index of the next pixel within the region, row by row. After next() the parts before it are complete.
  std::uint64_t nextPixel() const { return std::uint64_t{row_} * region_.width + column_; }
  // The next part: at most `pixels` >= 1 pixels. Call only if isDone() is false.
  render::Region next(std::uint64_t pixels);

 private:
  render::Region region_;
  std::uint32_t row_ = 0, column_ = 0;
};

}  // namespace malus::vulkan
