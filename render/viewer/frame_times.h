// Times of the last frames, for the plot and the medians of the panel.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

namespace malus::viewer {

class FrameTimes {
 public:
  static constexpr std::size_t kKept = 200;         // of the plot
  static constexpr std::size_t kMedianFrames = 30;  // of the median

  void add(double ms);
  void clear() { count_ = 0; }
  std::size_t count() const { return count_ < kKept ? count_ : kKept; }
  // Of the last kMedianFrames frames, or of all if they are fewer; 0 without frames.
  double median() const;
  // Oldest first.
  std::vector<float> values() const;

 private:
  std::array<float, kKept> ring_{};
  std::size_t count_ = 0;  // of all frames
};

// Share of the sorted values below the result, 0 to 1, by the nearest rank; 0 without values.
double quantile(std::vector<double> values, double share);

}  // namespace malus::viewer
