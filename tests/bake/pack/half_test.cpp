#include "bake/pack/half.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace malus::pack {
namespace {

// Returns the value of a finite half by its definition.
double decodeHalf(std::uint16_t bits) {
  const int exponent = bits >> 10 & 31, fraction = bits & 1023;
  const double magnitude = exponent == 0 ? std::ldexp(fraction, -24) : std::ldexp(1024 + fraction, exponent - 25);
  return (bits & 0x8000) != 0 ? -magnitude : magnitude;
}

TEST(Half, EveryFiniteHalfComesBack) {
  for (std::uint32_t bits = 0; bits < 65536; ++bits) {
    const auto half = static_cast<std::uint16_t>(bits);
    if ((half & 0x7c00) == 0x7c00) continue;
    ASSERT_EQ(static_cast<double>(floatFromHalf(half)), decodeHalf(half)) << bits;
    ASSERT_EQ(halfFromFloat(floatFromHalf(half)), half) << bits;
  }
}

TEST(Half, RoundsToNearestAndTiesToEven) {
  for (std::uint32_t bits = 0; bits < 0x7bff; ++bits) {
    const auto low = static_cast<std::uint16_t>(bits), high = static_cast<std::uint16_t>(bits + 1);
    const auto middle = static_cast<float>((decodeHalf(low) + decodeHalf(high)) / 2);  // exact in float
    ASSERT_EQ(halfFromFloat(middle), (bits & 1) == 0 ? low : high) << bits;
    ASSERT_EQ(halfFromFloat(std::nextafter(middle, 0.0f)), low) << bits;
    ASSERT_EQ(halfFromFloat(std::nextafter(middle, 1e9f)), high) << bits;
    ASSERT_EQ(halfFromFloat(-middle), 0x8000 | ((bits & 1) == 0 ? low : high)) << bits;
  }
}

TEST(Half, ErrorIsHalfAStep) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> exponent(-14, 15.99);
  for (int i = 0; i < 100000; ++i) {
    const auto value = static_cast<float>(std::exp2(exponent(random)));
    const float back = floatFromHalf(halfFromFloat(value));
    ASSERT_LE(std::abs(back - value), value * std::exp2(-11.0f)) << value;
  }
}

TEST(Half, Saturates) {
  EXPECT_EQ(floatFromHalf(halfFromFloat(65504)), 65504);
  EXPECT_EQ(floatFromHalf(halfFromFloat(65519)), 65504);
  EXPECT_EQ(floatFromHalf(halfFromFloat(1e30f)), 65504);
  EXPECT_EQ(floatFromHalf(halfFromFloat(-1e30f)), -65504);
  EXPECT_EQ(floatFromHalf(halfFromFloat(std::numeric_limits<float>::infinity())), 65504);
}

TEST(Half, SmallNumbers) {
  EXPECT_EQ(halfFromFloat(0.0f), 0);
  EXPECT_EQ(halfFromFloat(-0.0f), 0x8000);
  EXPECT_EQ(halfFromFloat(std::numeric_limits<float>::denorm_min()), 0);
  EXPECT_EQ(halfFromFloat(std::exp2(-24.0f)), 1);
  EXPECT_EQ(halfFromFloat(std::exp2(-25.0f)), 0);  // a tie: to even
}

TEST(Half, NanStaysNan) { EXPECT_TRUE(std::isnan(floatFromHalf(halfFromFloat(std::nanf(""))))); }

}  // namespace
}  // namespace malus::pack
