// The share of the resolution at which a moving image keeps its frame rate. Pure: it sees measured times only.
#pragma once

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

 private:
  // The goal is below the limit, because times vary and the display needs its part.
  static constexpr double kGoalMs = 0.55 * kLongestFrameMs;
  double fraction_ = 0.25;
};

}  // namespace malus::viewer
