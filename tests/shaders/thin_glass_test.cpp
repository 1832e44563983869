// The pane of thin_glass.h against the sum of all internal reflections, in long double, and against its limits.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;

struct Pane {
  Real rs, rp, x, ts, tp, y;
};

// Amplitudes r_s = (c - t)/(c + t) and r_p = (eta^2 c - t)/(eta^2 c + t) times the sign of the optics' convention,
// powers T = 4 c t/(c + t)^2, and the geometric series in closed form with T and T_s + T_p - T_s T_p, which do not
// cancel.
Pane paneInLongDouble(Real c, Real n1, Real n2, Real internal) {
  const Real eta = n2 / n1, sinSq = (1 - c) * (1 + c), tSq = eta * eta - sinSq;
  if (tSq <= 0) return {1, 1, 0, 0, 0, 0};
  const Real t = std::sqrt(tSq), s = c + t, p = eta * eta * c + t;
  const Real as = (c - t) / s, ap = (eta * eta * c - t) / p;  // r_p = -r_s at normal incidence
  const Real ts = 4 * c * t / (s * s), tp = 4 * c * t * eta * eta / (p * p);
  const Real x = -std::log(internal) * eta / t, aSq = std::exp(-2 * x), loss = -std::expm1(-2 * x);
  const auto sum = [&](Real amplitude, Real through, Real& reflected, Real& transmitted) {
    const Real denominator = loss + aSq * through * (2 - through), r = amplitude * amplitude;
    transmitted = denominator > 0 ? through * std::exp(-x) * (through / denominator) : 0;
    reflected = denominator > 0 ? r * (1 + aSq * through * (through / denominator)) : 1;
  };
  Pane pane{};
  sum(as, ts, pane.rs, pane.ts);
  sum(ap, tp, pane.rp, pane.tp);
  const Real denominator = loss + aSq * (ts + tp - ts * tp), pair = denominator > 0 ? ts * (tp / denominator) : 0;
  pane.y = std::exp(-x) * pair;
  pane.x = as * ap * (1 + aSq * pair);
  return pane;
}

MALUS_OPTICS_SUITE(ThinGlassTest);

TYPED_TEST(ThinGlassTest, EqualsTheClosedFormDownToGrazingIncidence) {
  MALUS_TYPES;
  Draw draw(31);
  Worst reflected("reflected", double(kEps)), transmitted("transmitted", double(kEps));
  for (int i = 0; i < 20000; ++i) {
    const real c = R(std::pow(10.0, draw.between(-9, 0))), n1 = R(draw.below(3) == 0 ? 1.33 : 1.0),
               n2 = R(draw.between(1.34, 2.5)),
               internal = R(draw.below(2) == 0 ? 1.0 : std::exp(-std::pow(10.0, draw.between(-6, 1))));
    const auto pane = O::thinGlass(c, n1, n2, internal);
    const Pane truth = paneInLongDouble(c, n1, n2, internal);
    reflected.add(pane.reflected.rs - truth.rs);
    reflected.add(pane.reflected.rp - truth.rp);
    reflected.add(pane.reflected.xRe - truth.x);
    // Relative: the transmitted power vanishes with the cosine.
    if (truth.tp > 1e-30L) {
      transmitted.add((pane.transmitted.rs - truth.ts) / truth.ts);
      transmitted.add((pane.transmitted.rp - truth.tp) / truth.tp);
      transmitted.add((pane.transmitted.xRe - truth.y) / truth.y);
    }
  }
  EXPECT_LT(reflected.value(), 40);
  EXPECT_LT(transmitted.value(), 400);  // e^-x magnifies the rounding of x
}

TYPED_TEST(ThinGlassTest, EqualsTheSeriesOfInternalReflections) {
  MALUS_TYPES;
  for (const Real c : {1.0L, 0.8L, 0.5L, 0.2L}) {
    const Real n = 1.5L, x0 = 0.3L, t = std::sqrt(n * n - (1 - c) * (1 + c)), a = std::exp(-x0 * n / t);
    const Real as = (c - t) / (c + t), ap = (n * n * c - t) / (t + n * n * c), rs = as * as, rp = ap * ap, x = as * ap;
    Real ts = 0, tp = 0, y = 0, bs = rs, bp = rp, bx = x;
    const Real enterS = 1 - rs, enterP = 1 - rp, enterX = enterS * enterP;  // both passages of the cross term
    for (int k = 0; k < 400; ++k) {
      const Real through = std::pow(a, 2 * k + 1), back = std::pow(a, 2 * k + 2);
      ts += enterS * enterS * std::pow(rs, 2 * k) * through;
      tp += enterP * enterP * std::pow(rp, 2 * k) * through;
      y += enterX * std::pow(x, 2 * k) * through;
      bs += enterS * enterS * std::pow(rs, 2 * k + 1) * back;
      bp += enterP * enterP * std::pow(rp, 2 * k + 1) * back;
      bx += enterX * std::pow(x, 2 * k + 1) * back;
    }
    const auto pane = O::thinGlass(R(c), R(1.0), R(n), R(std::exp(-x0)));
    const real bound = 20 * kEps;
    EXPECT_NEAR(double(pane.transmitted.rs), double(ts), bound);
    EXPECT_NEAR(double(pane.transmitted.rp), double(tp), bound);
    EXPECT_NEAR(double(pane.transmitted.xRe), double(y), bound);
    EXPECT_NEAR(double(pane.reflected.rs), double(bs), bound);
    EXPECT_NEAR(double(pane.reflected.rp), double(bp), bound);
    EXPECT_NEAR(double(pane.reflected.xRe), double(bx), bound);
  }
}

TYPED_TEST(ThinGlassTest, ReflectsEverythingAtGrazingIncidence) {
  MALUS_TYPES;
  for (const real internal : {R(1.0), R(0.999), R(0.1)}) {
    const auto pane = O::thinGlass(R(0.0), R(1.0), R(1.5), internal);
    EXPECT_NEAR(pane.reflected.rs, R(1.0), 4 * kEps);
    EXPECT_NEAR(pane.reflected.rp, R(1.0), 4 * kEps);
    EXPECT_NEAR(pane.reflected.xRe, R(1.0), 4 * kEps);
    EXPECT_EQ(pane.transmitted.rs, R(0.0));
    EXPECT_EQ(pane.transmitted.rp, R(0.0));
    EXPECT_EQ(pane.transmitted.xRe, R(0.0));
  }
}

TYPED_TEST(ThinGlassTest, ReflectsTotallyFromTheDenserSide) {
  MALUS_TYPES;
  const auto pane = O::thinGlass(R(0.1), R(1.5), R(1.0), R(0.6));
  const auto single = O::dielectricReflectance(R(0.1), R(1.5), R(1.0));
  EXPECT_EQ(pane.reflected.rs, R(1.0));
  EXPECT_EQ(pane.reflected.rp, R(1.0));
  EXPECT_CLOSE(pane.reflected.xRe, single.xRe, 8 * kExact);
  EXPECT_CLOSE(pane.reflected.xIm, single.xIm, 8 * kExact);
  EXPECT_EQ(pane.transmitted.rs, R(0.0));
}

TYPED_TEST(ThinGlassTest, EqualIndicesLeaveAbsorptionAlone) {
  MALUS_TYPES;
  const auto clear = O::thinGlass(R(0.3), R(1.33), R(1.33), R(1.0));
  EXPECT_CLOSE(clear.transmitted.rs, R(1.0), kExact);
  EXPECT_CLOSE(clear.transmitted.rp, R(1.0), kExact);
  EXPECT_CLOSE(clear.transmitted.xRe, R(1.0), kExact);
  EXPECT_EQ(clear.reflected.rs, R(0.0));
  EXPECT_EQ(clear.reflected.xRe, R(0.0));
}

TYPED_TEST(ThinGlassTest, ConservesEnergyAndNeverOverpolarizes) {
  MALUS_TYPES;
  Draw draw(32);
  for (int i = 0; i < 20000; ++i) {
    const real c = R(draw.between(0, 1)), n2 = R(draw.between(0.5, 3)),
               internal = R(draw.below(2) == 0 ? 1.0 : draw.between(0.1, 1));
    const auto pane = O::thinGlass(c, R(1.0), n2, internal);
    const real sumS = pane.reflected.rs + pane.transmitted.rs, sumP = pane.reflected.rp + pane.transmitted.rp;
    ASSERT_LE(sumS, 1 + 8 * kEps);
    ASSERT_LE(sumP, 1 + 8 * kEps);
    if (internal == 1) {
      ASSERT_NEAR(double(sumS), 1, double(8 * kEps));
      ASSERT_NEAR(double(sumP), 1, double(8 * kEps));
    }
    for (const auto& m : {pane.reflected, pane.transmitted})
      ASSERT_LE(m.xRe * m.xRe + m.xIm * m.xIm, m.rs * m.rp * (1 + 32 * kEps) + 4 * kEps * kEps);
  }
}

// Interfaces on a share of the pane: the rest only absorbs, along the refracted ray.
TYPED_TEST(ThinGlassTest, AShareOfThePane) {
  MALUS_TYPES;
  for (const real c : {R(0.9), R(0.3)}) {
    const real n = R(1.5), internal = R(0.7);
    const auto terms = O::refractionTerms(c, R(1.0), n);
    const auto whole = O::thinGlass(c, R(1.0), n, internal);
    EXPECT_CLOSE(O::partialThinGlass(c, terms, internal, R(1.0)).transmitted.rs, whole.transmitted.rs, 16 * kExact);
    const auto half = O::partialThinGlass(c, terms, internal, R(0.5));
    const Real cosine = std::sqrt(1 - (1 - Real(c) * c) / (Real(n) * n)), open = std::pow(Real(internal), 1 / cosine);
    EXPECT_CLOSE(half.reflected.rs, whole.reflected.rs / 2, 2 * kEps);
    EXPECT_CLOSE(half.transmitted.rp, (whole.transmitted.rp + open) / 2, 16 * kEps);
    EXPECT_CLOSE(half.transmitted.xRe, (whole.transmitted.xRe + open) / 2, 16 * kEps);
  }
  const auto total = O::partialThinGlass(R(0.1), O::refractionTerms(R(0.1), R(1.5), R(1.0)), R(1.0), R(0.5));
  EXPECT_EQ(total.reflected.rs, R(1.0));
  EXPECT_EQ(total.transmitted.rs, R(0.0));
}

}  // namespace
}  // namespace malus::test
