// The time limit of a comparison: half of it is for the first pass, shared equally by the views; the rounds use the
// rest.
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <optional>

namespace malus::render {

// ComparisonSettings::compileMinutes by --minutes: a quarter of the whole time, because a method that has been started
// may take as long again; at most 5 minutes. 0, for no limit, if there is none for the whole.
inline double compileMinutes(const std::optional<double>& minutes) {
  constexpr double kMost = 5, kShare = 0.25;
  return minutes ? std::min(kMost, kShare * *minutes) : kMost;
}

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
