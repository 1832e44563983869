#include "render/viewer/adaptive_resolution.h"

#include <algorithm>
#include <cmath>

namespace malus::viewer {

void AdaptiveResolution::add(double fraction, double ms) {
  if (!(ms > 0) || !(fraction > 0)) return;
  constexpr double kMostGrowth = 1.25, kLeastChange = 0.06;
  const double fitting = fraction * std::sqrt(goalMs() / ms);
  const double next = std::clamp(std::min(fitting, kMostGrowth * fraction), kLeast, 1.0);
  // A small change would only make the image flicker; the full resolution is worth a small change.
  const bool isSmall = std::abs(next - fraction_) < kLeastChange * fraction_;
  if (!isSmall || next == 1.0 || ms > kLongestFrameMs) fraction_ = next;
}

}  // namespace malus::viewer
