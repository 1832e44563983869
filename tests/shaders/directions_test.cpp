// Mirror and refracted directions against vectors in long double.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_OPTICS_SUITE(DirectionsTest);

// A ray at angle `degrees` on a plane with normal n, in the type's rounding.
template <class O>
struct Incidence {
  Vec d, n;  // as rounded, made unit again
  typename O::real3 dRounded, nRounded;
  typename O::real c;
};
template <class O>
Incidence<O> incidence(Draw& draw, Real degrees) {
  const Vec n = draw.direction(), across = oracle::anyAcross(n);
  const Real a = degrees * std::acos(Real(-1)) / 180;
  Incidence<O> r;
  r.dRounded = toReal3<O>(oracle::along(n, -std::cos(a), across, std::sin(a)));
  r.nRounded = toReal3<O>(n);
  r.c = O::clampUnit(-O::dot3(r.dRounded, r.nRounded));
  r.d = oracle::unit(toVec(r.dRounded));
  r.n = oracle::unit(toVec(r.nRounded));
  return r;
}

TYPED_TEST(DirectionsTest, ReflectionLaw) {
  MALUS_TYPES;
  Draw draw(6);
  Worst worst("mirror", double(kEps));
  for (int i = 0; i < 3000; ++i) {
    const auto in = incidence<O>(draw, draw.between(0, 90));
    const Vec got = toVec(O::mirrorDirection(in.dRounded, in.nRounded, in.c)), want = oracle::mirrored(in.d, in.n);
    for (std::size_t j = 0; j < 3; ++j) worst.add(got[j] - want[j]);
    worst.add(oracle::dot(got, got) - 1);
  }
  EXPECT_LT(worst.value(), 6);  // d and n are unit to 1 eps only, and c is counted twice
}

TYPED_TEST(DirectionsTest, SnellsLaw) {
  MALUS_TYPES;
  Draw draw(7);
  constexpr double kPairs[][2] = {{1, 1.5}, {1.5, 1}, {1, 2.42}, {2.42, 1.33}, {1, 1.0001}, {1.5168, 1.5167}};
  Worst worst("refraction", double(kEps));
  for (const auto& pair : kPairs)
    for (int i = 0; i < 1000; ++i) {
      const auto in = incidence<O>(draw, draw.between(0, 89.9));
      const Real n1 = R(pair[0]), n2 = R(pair[1]), sinT = n1 / n2 * std::sqrt(1 - std::pow(oracle::dot(in.d, in.n), 2));
      if (sinT > 0.995L) continue;
      const Vec got = toVec(O::refractedDirection(in.dRounded, in.nRounded, in.c, R(n1), R(n2)));
      const Vec want = oracle::refracted(in.d, in.n, n1, n2);
      // Close to the critical angle, and to grazing, the cosine's rounding is magnified by 1/cos.
      const Real steep = std::max(Real(1), 1 / std::sqrt(1 - sinT * sinT));
      for (std::size_t j = 0; j < 3; ++j) worst.add((got[j] - want[j]) / steep);
      worst.add(oracle::dot(got, got) - 1);
    }
  EXPECT_LT(worst.value(), 8);
}

TYPED_TEST(DirectionsTest, NormalIncidenceAndEqualIndicesDoNotDeflect) {
  MALUS_TYPES;
  Draw draw(8);
  for (int i = 0; i < 100; ++i) {
    const auto in = incidence<O>(draw, 0);
    const Vec through = toVec(O::refractedDirection(in.dRounded, in.nRounded, in.c, 1, R(1.5L)));
    const Vec back = toVec(O::mirrorDirection(in.dRounded, in.nRounded, in.c));
    const auto slanted = incidence<O>(draw, draw.between(0, 90));
    const Vec same = toVec(O::refractedDirection(slanted.dRounded, slanted.nRounded, slanted.c, R(1.33L), R(1.33L)));
    for (std::size_t j = 0; j < 3; ++j) {
      EXPECT_CLOSE(through[j], in.d[j], 3 * kEps);
      EXPECT_CLOSE(back[j], -in.d[j], 3 * kEps);
      EXPECT_CLOSE(same[j], slanted.d[j], 2 * kEps);
    }
  }
  // At grazing incidence, too, nothing is divided by 0.
  const real3 grazing = O::refractedDirection(O::make3(1, 0, 0), O::make3(0, 0, 1), 0, R(1.5L), R(1.5L));
  expectClose3(grazing, O::make3(1, 0, 0), kExact);
}

TYPED_TEST(DirectionsTest, SlabDoesNotDeflect) {
  MALUS_TYPES;
  Draw draw(9);
  for (int i = 0; i < 1000; ++i) {
    const auto in = incidence<O>(draw, draw.between(0, 80));
    const real3 inside = O::refractedDirection(in.dRounded, in.nRounded, in.c, 1, R(1.5L));
    const real3 out = O::refractedDirection(inside, in.nRounded, -O::dot3(inside, in.nRounded), R(1.5L), 1);
    const Real steep = 1 / in.c;  // near grazing the way out magnifies
    for (std::size_t j = 0; j < 3; ++j) EXPECT_CLOSE(toVec(out)[j], in.d[j], 8 * kEps * steep);
  }
}

TYPED_TEST(DirectionsTest, LongChainsStayNormalized) {
  MALUS_TYPES;
  Draw draw(10);
  real3 d = toReal3<O>(draw.direction());
  for (int i = 0; i < 1000; ++i) {
    real3 n = toReal3<O>(draw.direction());
    if (O::dot3(d, n) > 0) n = n * real(-1);
    d = O::mirrorDirection(d, n, -O::dot3(d, n));
  }
  EXPECT_CLOSE(oracle::dot(toVec(d), toVec(d)), 1, 3 * kEps);
}

}  // namespace
}  // namespace malus::test
