#include "bake/pack/half.h"

#include <algorithm>
#include <bit>

#include <glm/gtc/packing.hpp>

namespace malus::pack {

// Source: F. Giesen, float_to_half_fast3_rtne, https://gist.github.com/rygorous/2156668 (public domain).
std::uint16_t halfFromFloat(float value) {
  const auto bits = std::bit_cast<std::uint32_t>(std::clamp(value, -65504.0f, 65504.0f));
  const std::uint32_t sign = bits >> 16 & 0x8000u, magnitude = bits & 0x7fffffffu;
  if (magnitude > 0x7f800000u)
    return static_cast<std::uint16_t>(sign | 0x7e00u);  // a NaN stays a NaN, which the reader refuses
  // Below 2^-14 halfs are multiples of 2^-24, the last place of floats from 0.5 on: adding 0.5 rounds.
  if (magnitude < 0x38800000u)
    return static_cast<std::uint16_t>(
        sign | (std::bit_cast<std::uint32_t>(std::bit_cast<float>(magnitude) + 0.5f) - 0x3f000000u));
  // Otherwise the exponent loses 112 and the fraction 13 bits, rounded to nearest even.
  return static_cast<std::uint16_t>(sign | (magnitude - 0x38000000u + 0xfffu + (magnitude >> 13 & 1u)) >> 13);
}

float floatFromHalf(std::uint16_t bits) { return glm::unpackHalf1x16(bits); }

}  // namespace malus::pack
