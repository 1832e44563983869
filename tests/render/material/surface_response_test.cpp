// `malus material` against the independent Jones oracle: powers, phases and all sixteen numbers of both matrices.
#include "render/material/surface_response.h"

#include <numbers>

#include <gtest/gtest.h>

#include "tests/shaders/jones.h"

namespace malus::render {
namespace {

using oracle::Complex;
using oracle::Real;

// Mueller matrix of a Jones matrix that is diagonal in (s, p).
std::array<oracle::Stokes4, 4> diagonal(Complex s, Complex p) {
  oracle::Jones j;
  j.m[0][0] = s;
  j.m[1][1] = p;
  return oracle::muellerMatrix(j);
}

void expectMatrix(const std::array<double, 16>& got, const std::array<oracle::Stokes4, 4>& want, double allowed) {
  for (std::size_t row = 0; row < 4; ++row)
    for (std::size_t column = 0; column < 4; ++column)
      EXPECT_NEAR(got[4 * row + column], static_cast<double>(want[row][column]), allowed) << row << ' ' << column;
}

TEST(SurfaceResponse, EqualsJones) {
  const Interface interfaces[] = {
      {1, 1.5, 0}, {1.5, 1, 0}, {1.33, 1.5195, 0}, {1, 0.1884, 3.4034}, {1.5, 2.8924, 3.0655}};
  for (const Interface& interface : interfaces)
    for (double degrees = 0; degrees <= 89; degrees += 7.1)
      for (const Precision precision : {Precision::doublePrecision, Precision::singlePrecision}) {
        SCOPED_TRACE(testing::Message() << interface.n1 << " to " << interface.n2 << " at " << degrees);
        const double allowed = precision == Precision::doublePrecision ? 1e-14 : 2e-6;
        const SurfaceResponse r = surfaceResponse(interface, degrees, precision);
        const Complex n2(interface.n2, -interface.k2);
        const Real c = std::cos(degrees * std::numbers::pi_v<long double> / 180);
        const oracle::Amplitudes a = oracle::amplitudes(c, interface.n1, n2);
        EXPECT_NEAR(r.rs, static_cast<double>(std::norm(a.rs)), allowed);
        EXPECT_NEAR(r.rp, static_cast<double>(std::norm(a.rp)), allowed);
        expectMatrix(r.reflection, diagonal(a.rs, a.rp), allowed);
        const double phase = static_cast<double>(std::arg(a.rp * std::conj(a.rs))) * 180 / std::numbers::pi;
        // The sign of r_p is that of 0 at Brewster's angle.
        if (std::abs(a.rp) > 1e-2L) {
          EXPECT_NEAR(std::remainder(r.phaseDegrees - phase, 360), 0, 1e4 * allowed);
        }
        EXPECT_EQ(r.ts.has_value(), interface.k2 == 0);
        EXPECT_EQ(r.transmission.has_value(), interface.k2 == 0);
        if (!r.transmission) continue;
        const Real flux = (n2 * a.cosT).real() / (interface.n1 * c);
        EXPECT_NEAR(*r.ts, static_cast<double>(flux * std::norm(a.ts)), allowed);
        EXPECT_NEAR(*r.tp, static_cast<double>(flux * std::norm(a.tp)), allowed);
        EXPECT_NEAR(*r.ts + r.rs, 1, allowed);
        if (flux > 0) {
          expectMatrix(*r.transmission, diagonal(std::sqrt(flux) * a.ts, std::sqrt(flux) * a.tp), allowed);
        } else {
          for (const double v : *r.transmission) EXPECT_EQ(v, 0) << "total reflection";
        }
      }
}

TEST(SurfaceResponse, AtTheEnds) {
  const SurfaceResponse normal = surfaceResponse({1, 1.5, 0}, 0, Precision::doublePrecision);
  EXPECT_NEAR(normal.rs, 0.04, 1e-15);
  EXPECT_EQ(normal.diattenuation, 0);
  EXPECT_EQ(normal.phaseDegrees, 180);
  const SurfaceResponse grazing = surfaceResponse({1, 1.5, 0}, 90, Precision::singlePrecision);
  EXPECT_NEAR(grazing.rs, 1, 2e-7);
  EXPECT_EQ(*grazing.ts, 0);
  const SurfaceResponse none = surfaceResponse({1.5, 1.5, 0}, 90, Precision::doublePrecision);
  EXPECT_EQ(none.rs, 0);
  EXPECT_EQ(none.diattenuation, 0);
  EXPECT_EQ(*none.ts, 1);
}

}  // namespace
}  // namespace malus::render
