// Reference frames: the one that both ends of a ray agree on, and the turn to a surface's s direction.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_OPTICS_SUITE(FramesTest);

template <class O>
std::vector<typename O::real3> specialDirections() {
  using real = typename O::real;
  const real tiny = std::numeric_limits<real>::min(), zero = 0;
  std::vector<typename O::real3> list;
  for (const real z : {zero, -zero, tiny, -tiny, static_cast<real>(1e-38), static_cast<real>(-1e-38)})
    for (int i = 0; i < 16; ++i) {
      const Real phi = i * std::acos(Real(-1)) / 8;
      list.push_back(O::make3(static_cast<real>(std::cos(phi)), static_cast<real>(std::sin(phi)), z));
    }
  for (const real z : {real(1), real(-1)}) list.push_back(O::make3(0, 0, z));
  list.push_back(O::make3(tiny, -tiny, -1));
  return list;
}

TYPED_TEST(FramesTest, CanonicalFrameIsOrthonormalAndRightHanded) {
  MALUS_TYPES;
  Draw draw(3);
  std::vector<real3> list = specialDirections<O>();
  for (int i = 0; i < 5000; ++i) list.push_back(toReal3<O>(draw.direction()));
  Worst worst("frame", double(kEps));
  for (const real3& zGiven : list) {
    real3 x, y;
    O::canonicalFrame(zGiven, x, y);
    const Vec a = toVec(x), b = toVec(y), z = toVec(zGiven), along = oracle::cross(a, b);
    worst.add(oracle::dot(a, a) - 1);
    worst.add(oracle::dot(b, b) - 1);
    for (const Real d : {oracle::dot(a, b), oracle::dot(a, z), oracle::dot(b, z)}) worst.add(d);
    for (std::size_t i = 0; i < 3; ++i) worst.add(along[i] - z[i]);
    // And it is the frame that the shortest turn gives.
    const Vec expected = oracle::canonicalX(oracle::unit(z));
    for (std::size_t i = 0; i < 3; ++i) worst.add(a[i] - expected[i]);
  }
  EXPECT_LT(worst.value(), 4);  // a direction is itself unit to 1 eps only
}

TYPED_TEST(FramesTest, BothZerosGiveTheSameFrame) {
  MALUS_TYPES;
  for (int i = 0; i < 32; ++i) {
    const Real phi = i * std::acos(Real(-1)) / 16;
    real3 xPlus, yPlus, xMinus, yMinus;
    O::canonicalFrame(O::make3(R(std::cos(phi)), R(std::sin(phi)), R(0.0L)), xPlus, yPlus);
    O::canonicalFrame(O::make3(R(std::cos(phi)), R(std::sin(phi)), R(-0.0L)), xMinus, yMinus);
    EXPECT_EQ(xPlus, xMinus);
    EXPECT_EQ(yPlus, yMinus);
  }
}

TYPED_TEST(FramesTest, TurnEqualsTheExplicitAngle) {
  MALUS_TYPES;
  // A normal at angle a to the frame's x, tilted to the ray: s is perpendicular to it, at a + 90 degrees.
  const real3 x = O::make3(1, 0, 0), y = O::make3(0, 1, 0);
  for (int degree = 0; degree < 360; degree += 5)
    for (const double sine : {1.0, 0.5, 1e-3, 1e-10}) {
      const Real a = degree * std::acos(Real(-1)) / 180, f = a + std::acos(Real(-1)) / 2;
      const real3 n =
          O::make3(R(sine * std::cos(a)), R(sine * std::sin(a)), R(std::sqrt((1 - sine) * (1 + Real(sine)))));
      real cos2, sin2;
      O::sDirectionTurn(n, x, y, cos2, sin2);
      // The components of n carry the rounding of their own: absolute.
      EXPECT_CLOSE(cos2, std::cos(2 * f), 4 * kEps) << degree;
      EXPECT_CLOSE(sin2, std::sin(2 * f), 4 * kEps) << degree;
    }
}

TYPED_TEST(FramesTest, TurnIsUnitAndNeverNan) {
  MALUS_TYPES;
  Draw draw(4);
  for (int i = 0; i < 5000; ++i) {
    real3 x, y;
    const Vec z = draw.direction();
    O::canonicalFrame(toReal3<O>(z), x, y);
    // From grazing down to normal incidence.
    const Vec n = oracle::unit(oracle::along(z, 1, draw.direction(), std::pow(10.0L, -draw.between(-1, 20))));
    real cos2, sin2;
    O::sDirectionTurn(toReal3<O>(n), x, y, cos2, sin2);
    EXPECT_CLOSE(Real(cos2) * cos2 + Real(sin2) * sin2, 1, 6 * kEps);
  }
}

TYPED_TEST(FramesTest, NoTurnWherePlaneOfIncidenceDoesNotExist) {
  MALUS_TYPES;
  real cos2 = 5, sin2 = 5;
  O::sDirectionTurn(O::make3(0, 0, 1), O::make3(1, 0, 0), O::make3(0, 1, 0), cos2, sin2);
  EXPECT_EQ(cos2, 1);
  EXPECT_EQ(sin2, 0);
  // So little that its square vanishes counts as none.
  const real tiny = std::numeric_limits<real>::min();
  O::sDirectionTurn(O::make3(tiny, tiny, 1), O::make3(1, 0, 0), O::make3(0, 1, 0), cos2, sin2);
  EXPECT_EQ(cos2, 1);
  EXPECT_EQ(sin2, 0);
}

TYPED_TEST(FramesTest, SignOfTheNormalDoesNotMatter) {
  MALUS_TYPES;
  Draw draw(5);
  for (int i = 0; i < 100; ++i) {
    real3 x, y;
    O::canonicalFrame(toReal3<O>(draw.direction()), x, y);
    const real3 n = toReal3<O>(draw.direction());
    real c0, s0, c1, s1;
    O::sDirectionTurn(n, x, y, c0, s0);
    O::sDirectionTurn(n * real(-1), x, y, c1, s1);
    EXPECT_EQ(c0, c1);
    EXPECT_EQ(s0, s1);
  }
}

}  // namespace
}  // namespace malus::test
