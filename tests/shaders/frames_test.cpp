// Reference frames: the canonical frame of a ray, and the rotation to a surface's s direction.
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
    // It is the frame that the shortest rotation gives.
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
    expectClose3(xPlus, xMinus, kExact);
    expectClose3(yPlus, yMinus, kExact);
  }
}

TYPED_TEST(FramesTest, SIsPerpendicularToRayAndNormal) {
  MALUS_TYPES;
  Draw draw(4);
  Worst worst("s", double(kEps));
  for (int i = 0; i < 5000; ++i) {
    const real3 d = toReal3<O>(draw.direction());
    // From grazing down to normal incidence and past the last bit.
    const real3 n =
        toReal3<O>(oracle::unit(oracle::along(toVec(d), -1, draw.direction(), std::pow(10.0L, -draw.between(-1, 20)))));
    const real3 s = O::sDirection(d, n);
    const real3 mirror = O::mirrorDirection(d, n, O::clampUnit(-O::dot3(d, n)));
    worst.add(oracle::dot(toVec(s), toVec(s)) - 1);
    for (const real3& across : {d, n, mirror}) worst.add(oracle::dot(toVec(s), toVec(across)));
  }
  // Each component across carries four roundings; the mirror ray has twice the normal's error and its own.
  EXPECT_LT(worst.value(), 12);
}

TYPED_TEST(FramesTest, SIsPerpendicularToThePlaneOfIncidence) {
  MALUS_TYPES;
  Draw draw(5);
  for (int i = 0; i < 1000; ++i) {
    const Vec d = draw.direction(), n = draw.direction(), across = oracle::cross(d, n);
    const Real sine = std::sqrt(oracle::dot(across, across));
    if (sine < 1e-3L) continue;
    const Vec s = toVec(O::sDirection(toReal3<O>(d), toReal3<O>(n)));
    // The rounding of d and n rotates the plane by eps over the sine. The sign of s has no meaning.
    EXPECT_CLOSE(std::abs(oracle::dot(s, across)) / sine, 1, 8 * kEps) << i;
    const Vec off = oracle::cross(s, across);
    EXPECT_CLOSE(std::sqrt(oracle::dot(off, off)) / sine, 0, 8 * kEps / sine) << i;
  }
}

TYPED_TEST(FramesTest, RotationEqualsTheExplicitAngle) {
  MALUS_TYPES;
  const real3 x = O::make3(1, 0, 0), y = O::make3(0, 1, 0);
  for (int degree = 0; degree < 360; degree += 5) {
    const Real f = degree * std::acos(Real(-1)) / 180;
    real cos2, sin2;
    O::frameRotation(O::make3(R(std::cos(f)), R(std::sin(f)), 0), x, y, cos2, sin2);
    EXPECT_CLOSE(cos2, std::cos(2 * f), 4 * kEps) << degree;
    EXPECT_CLOSE(sin2, std::sin(2 * f), 4 * kEps) << degree;
  }
}

TYPED_TEST(FramesTest, RotationIsUnitAndFinite) {
  MALUS_TYPES;
  Draw draw(4);
  for (int i = 0; i < 5000; ++i) {
    real3 x, y;
    const real3 d = toReal3<O>(draw.direction());
    O::canonicalFrame(d * real(-1), x, y);
    // Whether or not s is perpendicular to the ray.
    const real3 s = i % 2 == 0 ? toReal3<O>(draw.direction()) : d;
    real cos2, sin2;
    O::frameRotation(s, x, y, cos2, sin2);
    EXPECT_CLOSE(Real(cos2) * cos2 + Real(sin2) * sin2, 1, 6 * kEps);
  }
}

TYPED_TEST(FramesTest, NormalIncidenceUsesCanonicalX) {
  MALUS_TYPES;
  const real3 d = O::make3(0, 0, -1), x = O::make3(1, 0, 0);
  EXPECT_EQ(O::sDirection(d, O::make3(0, 0, 1)), x);
  // So little that its square has lost its bits counts as none.
  for (const real tiny : {std::numeric_limits<real>::min(), std::numeric_limits<real>::denorm_min(), R(1e-16L)})
    EXPECT_EQ(O::sDirection(d, O::make3(tiny, tiny, 1)), x);
}

TYPED_TEST(FramesTest, SignOfTheNormalDoesNotMatter) {
  MALUS_TYPES;
  Draw draw(5);
  for (int i = 0; i < 100; ++i) {
    const real3 d = toReal3<O>(draw.direction()), n = toReal3<O>(draw.direction());
    const Vec across = oracle::cross(toVec(d), toVec(n));
    const Real sine = std::sqrt(oracle::dot(across, across));
    // Each has the error of SIsPerpendicularToThePlaneOfIncidence.
    expectClose3(O::sDirection(d, n), O::sDirection(d, n * real(-1)) * real(-1),
                 static_cast<double>(16 * kExact / sine));
  }
}

}  // namespace
}  // namespace malus::test
