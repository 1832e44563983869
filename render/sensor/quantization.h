// From charge to digital numbers.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace malus::render {

// Analogue-to-digital converter of a sensor.
struct Quantizer {
  double blackLevel = 0;     // DN
  double gain = 1;           // e- per DN
  double largestNumber = 1;  // 2^bits - 1

  // Rounds to the nearest number, halves away from zero, and clamps. NaN gives 0.
  std::uint16_t operator()(double electrons) const {
    const double number = blackLevel + electrons / gain;
    return static_cast<std::uint16_t>(std::isnan(number) ? 0 : std::lround(std::clamp(number, 0.0, largestNumber)));
  }
};

}  // namespace malus::render
