// The oracle itself: handedness from a field that rotates in time, amplitudes from Maxwell's equations.
#include "tests/shaders/jones.h"

#include <gtest/gtest.h>

namespace malus::oracle {
namespace {

constexpr Real kPi = 3.14159265358979323846L;
constexpr Real kTight = 1e-15L;  // thousands of roundings of long double where it has 64 bits

Real degrees(Real d) { return d * kPi / 180; }

TEST(JonesTest, S3IsPositiveForClockwiseSeenTowardTheSource) {
  // Right circular: seen by the receiver (x to the right, y up, z toward the receiver) E rotates clockwise.
  for (const Real phase : {kPi / 2, -kPi / 2}) {
    const Complex ex = 1, ey = std::polar(Real(1), phase);
    const auto angleAt = [&](Real wt) {
      const Complex turn = std::polar(Real(1), wt);
      return std::atan2((ey * turn).real(), (ex * turn).real());
    };
    const bool clockwise = angleAt(0.01L) < angleAt(0);
    const Stokes4 s = stokesFromField(ex, ey);
    EXPECT_NEAR(static_cast<double>(s[3]), clockwise ? 2 : -2, 1e-15);
  }
}

TEST(JonesTest, LinearPolarizationHasItsAngle) {
  for (const Real angle : {0.0L, 30.0L, 45.0L, 90.0L, 135.0L}) {
    const Stokes4 s = stokesFromField(std::cos(degrees(angle)), std::sin(degrees(angle)));
    EXPECT_NEAR(static_cast<double>(s[1]), static_cast<double>(std::cos(2 * degrees(angle))), 1e-15);
    EXPECT_NEAR(static_cast<double>(s[2]), static_cast<double>(std::sin(2 * degrees(angle))), 1e-15);
    EXPECT_NEAR(static_cast<double>(s[3]), 0, 1e-15);
  }
}

TEST(JonesTest, QuarterWaveWithFastXTurnsPlus45IntoLeftCircular) {
  // The slow axis lags: under e^{+iwt} its phase is -90 degrees.
  Jones plate;
  plate.m[0][0] = 1;
  plate.m[1][1] = Complex(0, -1);
  const auto m = muellerMatrix(plate);
  EXPECT_NEAR(static_cast<double>(m[3][2]), -1, 1e-15);
  EXPECT_NEAR(static_cast<double>(m[2][3]), 1, 1e-15);
}

// Fields on both sides of a plane z = 0: tangential E and H = index k x E are continuous.
void expectMaxwell(Real angle, Real n1, Complex n2) {
  const Real c = std::cos(degrees(angle)), sinI = std::sin(degrees(angle));
  const Amplitudes a = amplitudes(c, n1, n2);
  const Vec kIn{sinI, 0, c}, kOut{sinI, 0, -c};
  const Field kThrough{n1 * sinI / n2, 0, a.cosT};
  const Vec s{0, 1, 0};
  const Field sField{0, 1, 0};
  const auto expectContinuous = [&](const Field& in, const Field& out, const Field& through) {
    const Field hIn = cross(kIn, in), hOut = cross(kOut, out), hThrough = cross(kThrough, through);
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_LT(std::abs(in[i] + out[i] - through[i]), kTight);
      EXPECT_LT(std::abs(n1 * (hIn[i] + hOut[i]) - n2 * hThrough[i]), 1e-14L);
    }
  };
  const auto times = [](const Field& f, Complex k) { return Field{f[0] * k, f[1] * k, f[2] * k}; };
  expectContinuous(sField, times(sField, a.rs), times(sField, a.ts));
  const Vec pIn = cross(kIn, s), pOut = cross(kOut, s);
  expectContinuous(sum(pIn, 1, pIn, 0), sum(pOut, a.rp, pOut, 0), times(cross(kThrough, s), a.tp));
  EXPECT_LE((n2 * a.cosT).imag(), 0) << "the wave must not grow";
}

TEST(JonesTest, AmplitudesSatisfyMaxwell) {
  for (const Real angle : {0.0L, 20.0L, 45.0L, 56.3L, 80.0L, 89.9L}) {
    expectMaxwell(angle, 1, 1.5L);
    expectMaxwell(angle, 1.5L, 1);  // total reflection beyond 41.8 degrees
    expectMaxwell(angle, 1, Complex(0.1884L, -3.4034L));
    expectMaxwell(angle, 1.33L, Complex(2.9L, -3.0L));
    expectMaxwell(angle, 1, Complex(0, -2));
  }
}

TEST(JonesTest, BeamsAgreeWithMuellerMatrices) {
  // A diagonal Jones matrix in the (s, p) frame and the beam in space are the same reflection.
  const Vec n = unit({0.1L, -0.2L, 1}), k = unit({0.5L, 0.4L, -0.7L});
  const Complex gold(0.1884L, -3.4034L);
  const Vec s = sAcross(k, n);
  const Amplitudes a = amplitudes(std::abs(dot(k, n)), 1, gold);
  Jones j;
  j.m[0][0] = a.rs;
  j.m[1][1] = a.rp;
  const auto m = muellerMatrix(j);
  const Complex ex(0.3L, 0.4L), ey(-0.6L, 0.2L);
  const Stokes4 in = stokesFromField(ex, ey);
  const Stokes4 out = measured(reflect(polarized(k, s, ex, ey), n, 1, gold), s);
  for (std::size_t i = 0; i < 4; ++i) {
    Real expected = 0;
    for (std::size_t l = 0; l < 4; ++l) expected += m[i][l] * in[l];
    EXPECT_NEAR(static_cast<double>(out[i]), static_cast<double>(expected), 1e-15);
  }
}

TEST(JonesTest, EnergyConservation) {
  for (const Real c : {0.01L, 0.2L, 0.6L, 0.999L}) {
    const Powers p = powers(c, 1, 1.5L);
    EXPECT_NEAR(static_cast<double>(p.rs + p.ts), 1, 1e-15);
    EXPECT_NEAR(static_cast<double>(p.rp + p.tp), 1, 1e-15);
  }
}

}  // namespace
}  // namespace malus::oracle
