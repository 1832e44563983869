// IEEE 754 half floats as 16 bits: rounding to nearest even, saturating at 65504. A NaN stays a NaN.
#pragma once

#include <cstdint>

namespace malus::pack {

std::uint16_t halfFromFloat(float value);
float floatFromHalf(std::uint16_t bits);

}  // namespace malus::pack
