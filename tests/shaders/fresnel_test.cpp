// Reflectances, cross terms and transmittances against the Jones oracle and against closed forms. An oracle
// takes the rounded inputs; where the problem is ill conditioned (near the critical angle, near
// grazing) the error may be as large as the change caused by three eps in the inputs.
#include "tests/shaders/conditioned.h"
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Complex;
using oracle::Real;

MALUS_OPTICS_SUITE(FresnelTest);

// Error beyond the spread, in parts of the size.
Real beyond(Real got, Real expected, Real spread, Real size) {
  const Real error = std::abs(got - expected) - spread;
  return error <= 0 ? 0 : error / size;
}

template <class real>
std::vector<real> cosines() {
  std::vector<real> list = {0, std::numeric_limits<real>::min(), real(1e-6), std::nextafter(real(1), real(0)), 1};
  for (int i = 1; i < 200; ++i) list.push_back(static_cast<real>(i) / 200);
  return list;
}
constexpr double kPairs[][2] = {{1, 1.5}, {1.5, 1},     {1, 1.33},   {1.33, 1},        {1, 2.42},  {2.42, 1},
                                {1, 4},   {1.52, 1.33}, {1, 1.0001}, {1.5168, 1.5167}, {1.0001, 1}};

TYPED_TEST(FresnelTest, DielectricEqualsJones) {
  MALUS_TYPES;
  Worst rs("rs", double(kEps)), rp("rp", double(kEps)), x("x", double(kEps));
  for (const auto& pair : kPairs)
    for (const real c : cosines<real>()) {
      const real n1 = R(pair[0]), n2 = R(pair[1]);
      const auto got = O::dielectricReflectance(c, n1, n2);
      const auto want = conditioned(c, n1, n2, 3 * Real(kEps));
      // r_p and X vanish at Brewster's angle, where only R_s gives a size to compare with.
      const Real size = want.value.rs;
      rs.add(beyond(got.rs, want.value.rs, want.spread.rs, size));
      rp.add(beyond(got.rp, want.value.rp, want.spread.rp, size));
      x.add(beyond(std::abs(Complex(got.xRe, got.xIm) - want.value.x), 0, std::abs(want.spread.x), size));
    }
  // About ten roundings of eps/2 from the inputs to R_s; twelve for the others.
  EXPECT_LT(rs.value(), 6);
  EXPECT_LT(rp.value(), 6);
  EXPECT_LT(x.value(), 6);
}

TYPED_TEST(FresnelTest, TransmittanceEqualsJones) {
  MALUS_TYPES;
  Worst ts("ts", double(kEps)), tp("tp", double(kEps)), tx("tx", double(kEps));
  for (const auto& pair : kPairs)
    for (const real c : cosines<real>()) {
      const real n1 = R(pair[0]), n2 = R(pair[1]);
      const auto got = O::dielectricTransmittance(c, n1, n2);
      const auto want = conditioned(c, n1, n2, 3 * Real(kEps));
      const Real tiny = std::numeric_limits<real>::min();  // a cosine that small flushes
      // T is 4 c t/(c + t)^2, where t^2 is |eta^2 - 1| at least and c t may be flushed.
      const Real eta = Real(n2) / n1;
      const Real flushed = O::kRoundings == 1 ? Real(0) : 4 * tiny / std::min(Real(1), std::abs(eta * eta - 1));
      ts.add(beyond(got.ts, want.value.ts, want.spread.ts + flushed, want.value.ts + tiny));
      tp.add(beyond(got.tp, want.value.tp, want.spread.tp + flushed, want.value.tp + tiny));
      tx.add(beyond(got.x, want.value.txGeo, want.spread.txGeo + flushed, want.value.txGeo + tiny));
    }
  // Relative, grazing included: every factor is formed without a difference.
  EXPECT_LT(ts.value(), 6);
  EXPECT_LT(tp.value(), 6);
  EXPECT_LT(tx.value(), 6);
}

TYPED_TEST(FresnelTest, ConductorEqualsJones) {
  MALUS_TYPES;
  Worst rs("rs", double(kEps)), rp("rp", double(kEps)), x("x", double(kEps));
  const auto compare = [&](real c, real n1, real n, real k) {
    const auto got = O::conductorReflectance(c, n1, n, k);
    const auto want = conditioned(c, n1, Complex(n, -k), 3 * Real(kEps));
    rs.add(beyond(got.rs, want.value.rs, want.spread.rs, want.value.rs));
    rp.add(beyond(got.rp, want.value.rp, want.spread.rp, want.value.rs));
    x.add(beyond(std::abs(Complex(got.xRe, got.xIm) - want.value.x), 0, std::abs(want.spread.x), want.value.rs));
  };
  for (const real c : cosines<real>()) {
    for (const Metal& metal : kMetals)
      for (int i = 0; i < 3; ++i)
        for (const double n1 : {1.0, 1.33, 1.5}) compare(c, R(n1), R(metal.n[i]), R(metal.k[i]));
    // Weak absorption beyond the critical angle: where a naive root errs by 2e-4 in X.
    for (const double k : {1e-6, 1e-4, 1e-2}) {
      compare(c, 1, R(0.7), R(k));
      compare(c, 1, R(1.5), R(k));
    }
    compare(c, 1, 0, R(0.5));
    compare(c, 1, 0, 2);
    compare(c, 1, 0, 30);
    compare(c, 1, 1, 1);
    compare(c, 1, 100, 100);
  }
  // Some twenty roundings.
  EXPECT_LT(rs.value(), 12);
  EXPECT_LT(rp.value(), 12);
  EXPECT_LT(x.value(), 12);
}

TYPED_TEST(FresnelTest, NormalIncidence) {
  MALUS_TYPES;
  // ((n2 - n1)/(n2 + n1))^2, a handful of roundings; r_p = -r_s.
  for (const auto& pair : kPairs) {
    const Real n1 = R(pair[0]), n2 = R(pair[1]), f0 = (n2 - n1) / (n2 + n1) * ((n2 - n1) / (n2 + n1));
    const auto r = O::dielectricReflectance(1, R(n1), R(n2));
    EXPECT_CLOSE(r.rs / f0, 1, 5 * kEps);
    EXPECT_CLOSE(r.rs, r.rp, kExact * r.rs);
    EXPECT_CLOSE(r.xRe, -r.rs, kExact * r.rs);
    EXPECT_EQ(r.xIm, 0);
    const auto t = O::dielectricTransmittance(1, R(n1), R(n2));
    EXPECT_CLOSE(t.ts, 1 - f0, 4 * kEps);
    EXPECT_CLOSE(t.tp, 1 - f0, 4 * kEps);
    EXPECT_CLOSE(t.x, 1 - f0, 4 * kEps);
  }
  for (const Metal& m : kMetals) {
    const real n = R(m.n[0]), k = R(m.k[0]);
    const Real f0 = std::norm((Complex(n, -k) - Real(1)) / (Complex(n, -k) + Real(1)));
    const auto r = O::conductorReflectance(1, 1, n, k);
    EXPECT_CLOSE(r.rs / f0, 1, 6 * kEps);
    EXPECT_CLOSE(r.rp / f0, 1, 6 * kEps);
    EXPECT_CLOSE(r.xRe / f0, -1, 6 * kEps);
    EXPECT_CLOSE(r.xIm, 0, 2 * kEps);
  }
}

TYPED_TEST(FresnelTest, BrewsterAngle) {
  MALUS_TYPES;
  for (const double n : {1.1, 1.33, 1.5, 2.42, 4.0}) {
    const Real eta = R(n), c = 1 / std::sqrt(1 + eta * eta), cs = (eta * eta - 1) / (eta * eta + 1);
    const auto r = O::dielectricReflectance(R(c), 1, R(eta));
    EXPECT_CLOSE(r.rs, cs * cs, 4 * kEps);
    // The rounded cosine itself is off Brewster: absolute.
    EXPECT_CLOSE(r.rp, 0, 2 * kEps);
    EXPECT_CLOSE(r.xRe, 0, 2 * kEps);
    EXPECT_CLOSE(O::dielectricTransmittance(R(c), 1, R(eta)).tp, 1, 2 * kEps);
  }
}

TYPED_TEST(FresnelTest, GrazingIncidence) {
  MALUS_TYPES;
  for (const auto& pair : kPairs) {
    const auto r = O::dielectricReflectance(0, R(pair[0]), R(pair[1]));
    EXPECT_CLOSE(r.rs, 1, 2 * kEps);
    EXPECT_CLOSE(r.rp, 1, 2 * kEps);
    EXPECT_CLOSE(r.xRe, 1, 2 * kEps) << "r_p = r_s = -1";
    EXPECT_EQ(r.xIm, 0);
    EXPECT_EQ(O::dielectricTransmittance(0, R(pair[0]), R(pair[1])).ts, 0);
    EXPECT_EQ(O::dielectricTransmittance(0, R(pair[0]), R(pair[1])).tp, 0);
  }
  for (const Metal& m : kMetals) EXPECT_CLOSE(O::conductorReflectance(0, 1, R(m.n[0]), R(m.k[0])).rp, 1, 6 * kEps);
}

TYPED_TEST(FresnelTest, IndexMatchReflectsNothing) {
  MALUS_TYPES;
  for (const real c : cosines<real>())
    for (const double n : {1e-3, 1.0, 1.5168, 1e3}) {
      const auto r = O::dielectricReflectance(c, R(n), R(n));
      EXPECT_TRUE(r.rs == 0 && r.rp == 0 && r.xRe == 0 && r.xIm == 0) << c;
      const auto t = O::dielectricTransmittance(c, R(n), R(n));
      EXPECT_TRUE(t.ts == 1 && t.tp == 1 && t.x == 1) << c;
      const auto m = O::conductorReflectance(c, R(n), R(n), 0);
      EXPECT_TRUE(m.rs == 0 && m.rp == 0 && m.xRe == 0 && m.xIm == 0) << c;
    }
}

TYPED_TEST(FresnelTest, TotalReflectionAndItsPhases) {
  MALUS_TYPES;
  for (const double n : {1.33, 1.5, 2.42})
    for (int i = 0; i < 100; ++i) {
      const real n1 = R(n), c = static_cast<real>(i) / 100;
      const Real eta = 1 / Real(n1), sin2 = 1 - Real(c) * c;
      if (sin2 < eta * eta * (1 + 16 * Real(kEps))) continue;
      const auto r = O::dielectricReflectance(c, n1, 1);
      EXPECT_EQ(r.rs, 1);
      EXPECT_EQ(r.rp, 1);
      // tan(delta/2) = cos sqrt(sin^2 - eta^2)/sin^2; near the critical angle the root magnifies roundings.
      const Real gap = sin2 - eta * eta, delta = 2 * std::atan(c * std::sqrt(gap) / sin2);
      const Real allowed = 4 * kEps * (1 + 1 / std::sqrt(gap));
      EXPECT_CLOSE(r.xRe, std::cos(delta), allowed) << c;
      EXPECT_CLOSE(r.xIm, std::sin(delta), allowed) << c;
      const auto t = O::dielectricTransmittance(c, n1, 1);
      EXPECT_TRUE(t.ts == 0 && t.tp == 0 && t.x == 0);
    }
}

TYPED_TEST(FresnelTest, CriticalAngle) {
  MALUS_TYPES;
  // sin = 0.6 = n2/n1 up to rounding: R stays within [0, 1] and differs from 1 by no more than what the root
  // makes of four roundings: 1 - R_s = 4 c t/(c + t)^2, 1 - R_p = 4 c t/(eta^2 c) with t = 2 sqrt(eps).
  for (int step = -3; step <= 3; ++step) {
    real c = R(0.8L);
    for (int i = 0; i < std::abs(step); ++i) c = std::nextafter(c, step < 0 ? real(0) : real(1));
    const auto r = O::dielectricReflectance(c, R(1.25), R(0.75));
    EXPECT_LE(r.rs, 1);
    EXPECT_CLOSE(r.rs, 1, 16 * std::sqrt(kEps));
    EXPECT_CLOSE(r.rp, 1, 32 * std::sqrt(kEps));
    EXPECT_CLOSE(r.xRe, 1, 32 * std::sqrt(kEps));
    EXPECT_CLOSE(r.xIm, 0, 32 * std::sqrt(kEps));
    const auto t = O::dielectricTransmittance(c, R(1.25), R(0.75));
    EXPECT_CLOSE(t.ts, 0, 16 * std::sqrt(kEps));
    EXPECT_GE(t.ts, 0);
    EXPECT_CLOSE(t.tp, 0, 32 * std::sqrt(kEps));
  }
  // n1 = 1, n2 = 0.5, sin^2 = 0.25: the cosine's square is as near 3/4 as the type comes.
  const auto exact = O::dielectricReflectance(std::sqrt(real(0.75)), 1, R(0.5));
  EXPECT_CLOSE(exact.rs, 1, 16 * std::sqrt(kEps));
}

TYPED_TEST(FresnelTest, ConductorWithoutAbsorptionIsADielectric) {
  MALUS_TYPES;
  for (const auto& pair : kPairs)
    for (const real c : cosines<real>()) {
      const auto want = conditioned(c, R(pair[0]), R(pair[1]), 3 * Real(kEps));
      const auto d = O::dielectricReflectance(c, R(pair[0]), R(pair[1]));
      const auto m = O::conductorReflectance(c, R(pair[0]), R(pair[1]), 0);
      const Real size = 12 * kEps * want.value.rs;  // both errors of the two tests above
      EXPECT_CLOSE(m.rs, d.rs, size + 2 * want.spread.rs);
      EXPECT_CLOSE(m.rp, d.rp, size + 2 * want.spread.rp);
      EXPECT_CLOSE(m.xRe, d.xRe, size + 2 * std::abs(want.spread.x));
      EXPECT_CLOSE(m.xIm, d.xIm, size + 2 * std::abs(want.spread.x));
    }
}

TYPED_TEST(FresnelTest, PurelyImaginaryIndexIsAPerfectMirror) {
  MALUS_TYPES;
  // n = 0: nothing is absorbed and nothing passes, R = 1 at every angle.
  for (const real c : cosines<real>())
    for (const double k : {1e-3, 0.5, 1.0, 3.0, 1e3}) {
      const auto r = O::conductorReflectance(c, 1, 0, R(k));
      EXPECT_CLOSE(r.rs, 1, 8 * kEps) << c << ' ' << k;
      EXPECT_CLOSE(r.rp, 1, 12 * kEps) << c << ' ' << k;
      EXPECT_CLOSE(std::hypot(r.xRe, r.xIm), 1, 12 * kEps);
      EXPECT_GE(r.xIm, 0);
    }
}

TYPED_TEST(FresnelTest, EnergyConservation) {
  MALUS_TYPES;
  Worst sum("sum", double(kEps));
  for (const auto& pair : kPairs)
    for (const real c : cosines<real>()) {
      const auto terms = O::refractionTerms(c, R(pair[0]), R(pair[1]));
      const auto r = O::reflectanceFromTerms(c, terms);
      const auto t = O::transmittanceFromTerms(c, terms);
      sum.add(Real(r.rs) + t.ts - 1);
      sum.add(Real(r.rp) + t.tp - 1);
      EXPECT_CLOSE(t.x * t.x, t.ts * t.tp, 6 * kEps);
    }
  EXPECT_LT(sum.value(), 8);  // R near 1 has the relative error of (eta^2-1)^2/(c+t)^4
}

TYPED_TEST(FresnelTest, Reciprocity) {
  MALUS_TYPES;
  for (const auto& pair : kPairs)
    for (const real c : cosines<real>()) {
      const Real n1 = R(pair[0]), n2 = R(pair[1]), sinT = n1 / n2 * std::sqrt(1 - Real(c) * c);
      if (c < real(0.01) || sinT > 0.999L) continue;
      const real ct = R(std::sqrt((1 - sinT) * (1 + sinT)));
      const auto in = O::dielectricTransmittance(c, R(n1), R(n2));
      const auto out = O::dielectricTransmittance(ct, R(n2), R(n1));
      const auto forth = conditioned(c, n1, n2, 3 * Real(kEps)), back = conditioned(ct, n2, n1, 3 * Real(kEps));
      EXPECT_CLOSE(in.ts, out.ts, 8 * kEps + forth.spread.ts + back.spread.ts) << c;
      EXPECT_CLOSE(in.tp, out.tp, 8 * kEps + forth.spread.tp + back.spread.tp) << c;
    }
}

TYPED_TEST(FresnelTest, EveryValidInputStaysPhysical) {
  MALUS_TYPES;
  // Indices from 1e-3 to 1e3 on both sides, k alike or 0, every cosine.
  const double indices[] = {1e-3, 1e-2, 0.1, 0.5, 0.9999999, 1, 1.0000001, 1.5, 10, 100, 1e3};
  const auto expectPhysical = [&](const auto& r, real c, double n1, double n2, double k) {
    const real values[] = {r.rs, r.rp, r.xRe, r.xIm};
    for (const real v : values) ASSERT_TRUE(std::isfinite(v)) << c << ' ' << n1 << ' ' << n2 << ' ' << k;
    ASSERT_TRUE(r.rs >= 0 && r.rs <= 1 && r.rp >= 0 && r.rp <= 1) << c << ' ' << n1 << ' ' << n2 << ' ' << k;
    // |X|^2 = R_s R_p; X is R_s rho, where R_p may have been cut at 1.
    EXPECT_CLOSE(std::hypot(r.xRe, r.xIm), std::sqrt(r.rs * r.rp), 8 * kEps) << c << ' ' << n1 << ' ' << n2 << ' ' << k;
  };
  for (const double n1 : indices)
    for (const double n2 : indices)
      for (const real c : cosines<real>()) {
        expectPhysical(O::dielectricReflectance(c, R(n1), R(n2)), c, n1, n2, 0);
        const auto t = O::dielectricTransmittance(c, R(n1), R(n2));
        ASSERT_TRUE(t.ts >= 0 && t.ts <= 1 && t.tp >= 0 && t.tp <= 1 && t.x >= 0 && t.x <= 1) << c;
        for (const double k : {0.0, 1e-6, 1e-3, 1.0, 1e3}) {
          expectPhysical(O::conductorReflectance(c, R(n1), R(n2), R(k)), c, n1, n2, k);
          if (k >= 1e-3) expectPhysical(O::conductorReflectance(c, R(n1), 0, R(k)), c, n1, 0, k);
        }
      }
}

TYPED_TEST(FresnelTest, ExtremeRatiosEqualJones) {
  MALUS_TYPES;
  // Relative to 1: eta^2 far under the spacing of 1 must not vanish beside it.
  Worst worst("extreme", double(kEps));
  for (const double n1 : {1e-3, 1.0, 1e3})
    for (const double n2 : {1e-3, 1e-2, 1.0, 1e3})
      for (const real c : cosines<real>()) {
        if (n1 == n2) continue;
        const auto got = O::dielectricReflectance(c, R(n1), R(n2));
        const auto want = conditioned(c, R(n1), R(n2), 3 * Real(kEps));
        worst.add(beyond(got.rs, want.value.rs, want.spread.rs, 1));
        worst.add(beyond(got.rp, want.value.rp, want.spread.rp, 1));
      }
  EXPECT_LT(worst.value(), 8);
}

}  // namespace
}  // namespace malus::test
