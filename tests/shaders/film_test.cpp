// Thin films against textbook cases and against the characteristic matrices of plane layers (Abeles; Born and Wolf,
// 1.6.2), which share no formula with Airy's sum.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using Cx = oracle::Complex;

constexpr Real kPi = 3.14159265358979323846L;

struct Stack {
  Cx rs, rp, ts, tp;  // amplitudes of the electric field; p as in oracle::Amplitudes
  Real fluxS = 0, fluxP = 0;
};

// Medium n1, a layer nf whose thickness over the vacuum wavelength is d, medium n3 - i k3.
Stack layered(Real c, Real n1, Real nf, Real d, Cx n3) {
  const Real sine = n1 * std::sqrt((1 - c) * (1 + c));  // along the surface, the same everywhere
  const auto across = [&](Cx n) {
    Cx q = std::sqrt(n * n - sine * sine);
    if (q.imag() > 0 || (q.imag() == 0 && q.real() < 0)) q = -q;
    return q;
  };
  const Cx q1 = n1 * c, qf = across(nf), q3 = across(n3), beta = 2 * kPi * d * qf, i(0, 1);
  // Admittances of tangential fields: n cos for s, n/cos = n^2/q for p.
  const auto solve = [&](Cx y1, Cx yf, Cx y3, Cx& r, Cx& t) {
    const Cx b = std::cos(beta) + i * std::sin(beta) * y3 / yf, h = i * yf * std::sin(beta) + y3 * std::cos(beta);
    r = (y1 * b - h) / (y1 * b + h);
    t = Real(2) * y1 / (y1 * b + h);
  };
  Stack stack;
  solve(q1, qf, q3, stack.rs, stack.ts);
  solve(n1 * n1 / q1, nf * nf / qf, n3 * n3 / q3, stack.rp, stack.tp);
  stack.fluxS = (q3 / q1).real() * std::norm(stack.ts);
  stack.fluxP = ((n3 * n3 / q3) / (n1 * n1 / q1)).real() * std::norm(stack.tp);
  // From tangential fields to fields along p, which flips on reflection (r_p = -r_s at normal incidence).
  stack.rp = -stack.rp;
  stack.tp *= c / (q3 / n3);
  return stack;
}

MALUS_OPTICS_SUITE(FilmTest);

TYPED_TEST(FilmTest, EqualsTheCharacteristicMatrix) {
  MALUS_TYPES;
  Draw draw(7);
  Worst reflection("worstReflection", kEps), cross("worstCross", kEps), transmission("worstTransmission", kEps);
  for (int i = 0; i < 4000; ++i) {
    const real c = R(draw.between(0.05, 1)), n1 = R(draw.below(2) == 0 ? 1.0 : draw.between(1, 2)),
               nf = R(draw.between(1.05, 3)), turns = R(draw.between(0, 3)), n3 = R(draw.between(0.1, 4)),
               k3 = R(draw.below(2) == 0 ? 0.0 : draw.between(0.1, 5));
    // Away from both critical angles, where a rounding of the cosine moves everything.
    const auto near = [&](real n) { return std::abs((n / n1) * (n / n1) - (1 - c) * (1 + c)) < R(0.02); };
    if (near(nf) || (k3 == 0 && near(n3))) continue;
    const auto film = O::thinFilm(c, n1, nf, turns, n3, k3);
    const Stack truth = layered(c, n1, nf, static_cast<Real>(turns) / 2, Cx(n3, -k3));
    const Cx x = truth.rp * std::conj(truth.rs), y = truth.tp * std::conj(truth.ts);
    reflection.add(film.reflected.rs - std::norm(truth.rs));
    reflection.add(film.reflected.rp - std::norm(truth.rp));
    cross.add(film.reflected.xRe - x.real());
    cross.add(film.reflected.xIm - x.imag());
    if (k3 > 0) continue;
    transmission.add(film.through.rs - truth.fluxS);
    transmission.add(film.through.rp - truth.fluxP);
    const Real size = std::sqrt(truth.fluxS * truth.fluxP);
    if (size < 1e-3L) continue;
    transmission.add(film.through.xRe - size * (y / std::abs(y)).real());
    transmission.add(film.through.xIm - size * (y / std::abs(y)).imag());
  }
  EXPECT_LT(reflection.value(), 300);
  EXPECT_LT(cross.value(), 300);
  EXPECT_LT(transmission.value(), 2000);  // the phase of a small field
}

TYPED_TEST(FilmTest, ZeroThicknessIsTheBareInterface) {
  MALUS_TYPES;
  for (const real c : {R(1.0L), R(0.7L), R(0.2L), R(0.01L)}) {
    const auto metal = O::thinFilm(c, 1, R(1.46L), 0, R(0.2L), R(3.4L));
    const auto bare = O::conductorReflectance(c, 1, R(0.2L), R(3.4L));
    EXPECT_CLOSE(metal.reflected.rs, bare.rs, 32 * kEps);
    EXPECT_CLOSE(metal.reflected.rp, bare.rp, 32 * kEps);
    EXPECT_CLOSE(metal.reflected.xRe, bare.xRe, 32 * kEps);
    EXPECT_CLOSE(metal.reflected.xIm, bare.xIm, 32 * kEps);
    for (const auto& [n1, n3] : {std::pair(R(1.0L), R(1.5L)), std::pair(R(1.5L), R(1.0L))}) {
      const auto glass = O::thinFilm(c, n1, R(2.0L), 0, n3, 0);
      const auto interface = O::dielectricReflectance(c, n1, n3);
      const auto through = O::dielectricTransmittance(c, n1, n3);
      EXPECT_CLOSE(glass.reflected.rs, interface.rs, 64 * kEps);
      EXPECT_CLOSE(glass.reflected.rp, interface.rp, 64 * kEps);
      EXPECT_CLOSE(glass.reflected.xRe, interface.xRe, 256 * kEps);
      EXPECT_CLOSE(glass.reflected.xIm, interface.xIm, 256 * kEps);
      EXPECT_CLOSE(glass.through.xRe, through.x, 64 * kEps);
      EXPECT_CLOSE(glass.through.xIm, 0, 64 * kEps);
    }
  }
}

TYPED_TEST(FilmTest, QuarterWaveAndHalfWave) {
  MALUS_TYPES;
  const Real nf = 1.38L, n3 = 1.52L, reflected = (n3 - nf * nf) / (n3 + nf * nf), bare = (n3 - 1) / (n3 + 1);
  // A quarter of the wavelength in the film: twice its thickness over that in vacuum is 1/(2 nf).
  const auto quarter = O::thinFilm(1, 1, R(nf), R(1 / (2 * nf)), R(n3), 0);
  EXPECT_CLOSE(quarter.reflected.rs, reflected * reflected, 4 * kEps);
  EXPECT_CLOSE(quarter.through.rs, 1 - reflected * reflected, 4 * kEps);
  const auto half = O::thinFilm(1, 1, R(nf), R(1 / nf), R(n3), 0);
  EXPECT_CLOSE(half.reflected.rs, bare * bare, 8 * kEps);
  EXPECT_CLOSE(half.reflected.rp, bare * bare, 8 * kEps);
}

TYPED_TEST(FilmTest, PhysicalAtNormalAndGrazingIncidence) {
  MALUS_TYPES;
  for (const real c : {R(0), R(1e-30L), R(1e-6L), R(1)})
    for (const real n1 : {R(1), R(1.5L)})
      for (const real nf : {R(1), R(1.0001L), R(1.5L), R(3)})
        for (const real n3 : {R(0.001L), R(1), R(1.5L), R(1000)})
          for (const real k3 : {R(0), R(1e-3L), R(1000)})
            for (const real turns : {R(0), R(0.5L), R(400)}) {
              const auto f = O::thinFilm(c, n1, nf, turns, n3, k3);
              for (const auto& r : {f.reflected, f.through}) {
                ASSERT_TRUE(std::isfinite(r.rs) && std::isfinite(r.rp) && std::isfinite(r.xRe) && std::isfinite(r.xIm))
                    << c << ' ' << n1 << ' ' << nf << ' ' << n3 << ' ' << k3 << ' ' << turns;
                EXPECT_GE(r.rs, 0);
                EXPECT_LE(r.rs, 1);
                EXPECT_GE(r.rp, 0);
                EXPECT_LE(r.rp, 1);
                // A fully polarized field stays one: |X|^2 = R_s R_p.
                EXPECT_LE(std::hypot(r.xRe, r.xIm), std::sqrt(r.rs * r.rp) + 8 * kEps);
              }
            }
}

TYPED_TEST(FilmTest, ComplexExponentialAndSquareRoot) {
  MALUS_TYPES;
  Draw draw(3);
  for (int i = 0; i < 1000; ++i) {
    const real x = R(draw.between(-8, 8));
    const auto turn = O::cisTwoPi(x);
    EXPECT_CLOSE(turn.re, std::cos(2 * kPi * static_cast<Real>(x)), 8 * kEps);
    EXPECT_CLOSE(turn.im, std::sin(2 * kPi * static_cast<Real>(x)), 8 * kEps);
    const real a = R(draw.between(-2, 2)), b = R(draw.between(-2, 2));
    const auto root = O::complexSqrtLower(a, b);
    EXPECT_LE(root.im, 0);
    EXPECT_CLOSE(root.re * root.re - root.im * root.im, a, 16 * kEps);
    EXPECT_CLOSE(2 * root.re * -root.im, std::abs(b), 16 * kEps);
  }
}

}  // namespace
}  // namespace malus::test
