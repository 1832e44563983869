// Vector functions.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

MALUS_OPTICS_SUITE(VectorTest);

TYPED_TEST(VectorTest, NormalizeGivesLengthOneAndKeepsTheDirection) {
  MALUS_TYPES;
  Draw draw(1);
  for (int i = 0; i < 2000; ++i) {
    const oracle::Vec u = draw.direction();
    const oracle::Real size = std::pow(10.0L, draw.between(-15, 15));  // squares stay in range of float
    const real3 v = O::normalize3(toReal3<O>(oracle::along(u, size, u, 0)));
    EXPECT_CLOSE(std::sqrt(oracle::dot(toVec(v), toVec(v))), 1, 2 * kEps);
    EXPECT_CLOSE(v.x, u[0], 3 * kEps);
    EXPECT_CLOSE(v.y, u[1], 3 * kEps);
    EXPECT_CLOSE(v.z, u[2], 3 * kEps);
  }
}

TYPED_TEST(VectorTest, CrossIsRightHanded) {
  MALUS_TYPES;
  const real3 z = O::cross3(O::make3(1, 0, 0), O::make3(0, 1, 0));
  EXPECT_TRUE(z.x == 0 && z.y == 0 && z.z == 1);
  EXPECT_EQ(O::dot3(O::make3(1, 2, 3), O::make3(4, -5, 6)), 12);
}

TYPED_TEST(VectorTest, SignOfBothZerosIsPlus) {
  MALUS_TYPES;
  EXPECT_EQ(O::signNotZero(0), 1);
  EXPECT_EQ(O::signNotZero(R(-0.0L)), 1);
  EXPECT_EQ(O::signNotZero(std::numeric_limits<real>::min()), 1);
  EXPECT_EQ(O::signNotZero(-std::numeric_limits<real>::min()), -1);
}

TYPED_TEST(VectorTest, ClampsSelectsAndMaxima) {
  MALUS_TYPES;
  EXPECT_EQ(O::clampUnit(R(-0.5L)), 0);
  EXPECT_EQ(O::clampUnit(R(0.25L)), R(0.25L));
  EXPECT_EQ(O::clampUnit(1 + kEps), 1);
  EXPECT_EQ(O::square(-3), 9);
  const real3 a = O::make3(1, -2, 3), b = O::splat3(7);
  EXPECT_EQ(O::select3(true, a, b), a);
  EXPECT_EQ(O::select3(false, a, b), b);
  EXPECT_EQ(O::max3(a, 2), O::make3(2, 2, 3));
  EXPECT_EQ(O::kPi, R(3.14159265358979323846L));
}

TYPED_TEST(VectorTest, PowersBySquaring) {
  MALUS_TYPES;
  Draw draw(2);
  for (const int n : {0, 1, 2, 3, 5, 20, 64, 100, 1000, 4095}) {
    EXPECT_EQ(O::powInteger(1, n), 1);
    EXPECT_EQ(O::powInteger(0, n), n == 0 ? 1 : 0);
    for (int i = 0; i < 200; ++i) {
      const real x = R(draw.between(0.9, 1));
      const oracle::Real want = std::pow(static_cast<oracle::Real>(x), static_cast<oracle::Real>(n));
      // Squaring doubles the error made so far: n half-eps in all, what rounding x itself would cost.
      const oracle::Real allowed = n * 0.5L * kEps * want + std::numeric_limits<real>::min();
      EXPECT_CLOSE(O::powInteger(x, n), want, allowed) << x << '^' << n;
    }
  }
}

}  // namespace
}  // namespace malus::test
