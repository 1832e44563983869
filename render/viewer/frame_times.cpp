#include "render/viewer/frame_times.h"

#include <algorithm>
#include <cmath>

namespace malus::viewer {

void FrameTimes::add(double ms) { ring_[count_++ % kKept] = static_cast<float>(ms); }

std::vector<float> FrameTimes::values() const {
  std::vector<float> result;
  for (std::size_t i = count_ - count(); i < count_; ++i) result.push_back(ring_[i % kKept]);
  return result;
}

double FrameTimes::median() const {
  const std::vector<float> all = values();
  const std::size_t used = std::min(all.size(), kMedianFrames);
  return quantile({all.end() - static_cast<std::ptrdiff_t>(used), all.end()}, 0.5);
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  const auto rank = static_cast<std::size_t>(std::lround(share * static_cast<double>(values.size() - 1)));
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return values[rank];
}

}  // namespace malus::viewer
