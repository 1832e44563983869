// The time limit of a comparison: half of it is for the first pass, shared equally by the views; the rounds use the
// rest.
#pragma once

#include <chrono>
#include <cstddef>

namespace malus::render {

class TimeLimit {
 public:
  // minutes: 0 for no limit. Starts now.
  explicit TimeLimit(double minutes) : seconds_(minutes * 60) {}

  bool isOver() const { return seconds_ > 0 && elapsed() >= seconds_; }
  // 0 without a limit, 1 when it is over.
  double usedShare() const { return seconds_ > 0 ? elapsed() / seconds_ : 0; }
  // Whether the first pass of a view has used its share and what earlier views left.
  bool isFirstPassOver(std::size_t view, std::size_t views) const {
    return seconds_ > 0 && elapsed() >= 0.5 * seconds_ * static_cast<double>(view + 1) / static_cast<double>(views);
  }

 private:
  using Clock = std::chrono::steady_clock;
  double elapsed() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Clock::time_point start_ = Clock::now();
  double seconds_;
};

}  // namespace malus::render
