// The share of the resolution at which a moving image keeps its frame rate. Pure: it sees measured times only.
#pragma once

#include <algorithm>

namespace malus::viewer {

class AdaptiveResolution {
 public:
  static constexpr double kLongestFrameMs = 50;  // 20 frames per second
  // Least share of each side of the image: smaller images show nothing.
  static constexpr double kLeast = 1.0 / 16;

  // Share of width and height for the next frame, kLeast to 1.
  double fraction() const { return fraction_; }

  // Takes the time of a frame that was rendered at a fraction [ms]. The time of a frame is taken as proportional to its
  // pixels. A frame that was too slow takes effect at once; a faster one raises the fraction by at most a quarter, so
  // that one fast frame does not cause a slow one.
  void add(double fraction, double ms);

  // Time that the display takes of each frame [ms].
  void setDisplayMs(double ms) { displayMs_ = ms; }

 private:
  // Below the limit, because times vary; at least a part of it for the image, however slow the display is.
  double goalMs() const { return std::max(0.85 * kLongestFrameMs - displayMs_, 0.2 * kLongestFrameMs); }
  double displayMs_ = 0.3 * kLongestFrameMs;
  double fraction_ = 0.25;
};

}  // namespace malus::viewer
