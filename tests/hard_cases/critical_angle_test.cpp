// Total reflection: the critical angle, where R moves by 1e-3 within 1e-6 rad, and the phases beyond it.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(CriticalAngle);

constexpr Real kPi = 3.14159265358979323846L;

TYPED_TEST(CriticalAngle, NearCriticalAngle) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const auto& [n1, n2] : {std::pair(1.5, 1.0), {1.25, 0.75}, {1.33, 1.0}, {2.42, 1.0}, {1.5, 1.33}, {1.0, 0.5}}) {
    const Real angle = std::asin(Real(R(n2)) / Real(R(n1)));
    for (const Real off : {0.0L, 1e-6L, -1e-6L, 1e-7L, -1e-7L, 1e-4L, -1e-4L})
      in.push_back({R(std::cos(angle + off)), R(n1), R(n2), 0, B::splat3(0)});
    // All cosines of the type within a few steps.
    real c = R(std::cos(angle));
    for (int i = 0; i < 4; ++i) c = std::nextafter(c, real(0));
    for (int i = 0; i < 9; ++i, c = std::nextafter(c, real(1))) in.push_back({c, R(n1), R(n2), 0, B::splat3(0)});
  }
  // The oracle takes the rounded inputs; the effect of three roundings of them is allowed in addition.
  expectSurfaces<B>(in, 16);
  const auto out = B::surfaces(in);
  for (const auto& o : out) {
    EXPECT_CLOSE(o.dielectric.rs + o.transmittance.ts, 1, 8 * kUnit);
    EXPECT_CLOSE(o.dielectric.rp + o.transmittance.tp, 1, 8 * kUnit);
    if (o.total == 1) {
      EXPECT_EQ(o.dielectric.rs, 1);
      EXPECT_EQ(o.dielectric.rp, 1);
      EXPECT_EQ(o.transmittance.ts, 0);
      EXPECT_CLOSE(std::hypot(o.dielectric.xRe, o.dielectric.xIm), 1, 4 * kUnit);
    }
  }
}

TYPED_TEST(CriticalAngle, PhasesOfTotalReflection) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const double n : {1.33, 1.5, 2.42})
    for (int i = 0; i < 100; ++i) in.push_back({R(static_cast<Real>(i) / 100), R(n), 1, 0, B::splat3(0)});
  const auto out = B::surfaces(in);
  int total = 0;
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Real eta = 1 / Real(in[i].n1), c = in[i].c, sin2 = 1 - c * c, gap = sin2 - eta * eta;
    if (gap < 16 * kEps) continue;
    ++total;
    // tan(delta/2) = cos sqrt(sin^2 - eta^2)/sin^2 (Born and Wolf, 1.5.4); the root magnifies roundings near 0.
    const Real delta = 2 * std::atan(c * std::sqrt(gap) / sin2), allowed = 4 * kUnit * (1 + 1 / std::sqrt(gap));
    EXPECT_CLOSE(out[i].dielectric.xRe, std::cos(delta), allowed);
    EXPECT_CLOSE(out[i].dielectric.xIm, std::sin(delta), allowed);
  }
  EXPECT_GT(total, 150);
}

TYPED_TEST(CriticalAngle, FresnelRhombMakesCircularLight) {
  MALUS_BACKEND_TYPES;
  // Two total reflections at 53.2582 degrees in n = 1.5 delay by 45 degrees each; the light, polarized at 45
  // degrees to them by a Brewster mirror outside, leaves circular. Entering and leaving at normal incidence.
  const Real low = 53.2582L * kPi / 180;
  // The angle in full precision: tan(45/2 degrees) = cos sqrt(sin^2 - 1/n^2)/sin^2, by Newton's method on sin^2.
  Real x = std::sin(low) * std::sin(low);
  for (int i = 0; i < 60; ++i) {
    const auto f = [](Real y) { return std::sqrt((1 - y) * (y - 1 / 2.25L)) / y - std::tan(kPi / 8); };
    x -= f(x) / ((f(x + 1e-8L) - f(x - 1e-8L)) / 2e-8L);
  }
  const Real sine = std::sqrt(x), cosine = std::sqrt(1 - x);
  Draw draw(106);
  std::vector<typename B::ChainIn> chains;
  for (int i = 0; i < 100; ++i) {
    Path path;
    path.d.push_back(draw.direction());
    const Vec across = oracle::anyAcross(path.d[0]);
    extend(path, glassWindow(1, 1.5), path.d[0]);
    for (int bounce = 0; bounce < 2; ++bounce) {
      // Both in one plane, which contains `across`.
      const Vec d = path.d.back(), side = oracle::cross(oracle::cross(path.d[0], across), d);
      extend(path, glassMirror(1.5, 1), oracle::along(d, -cosine, oracle::unit(side), bounce == 0 ? sine : -sine));
    }
    extend(path, glassWindow(1.5, 1), path.d.back());
    const Vec d = path.d.back(), s = oracle::cross(path.d[0], across), p = oracle::cross(d, s);
    const Vec at45 = oracle::unit(oracle::along(s, 1, p, i % 2 == 0 ? 1 : -1));
    const Real c = 1 / std::sqrt(3.25L);
    extend(path, glassMirror(), oracle::along(d, -c, at45, std::sqrt(1 - c * c)));
    chains.push_back(chainFromPath<B>(path));
  }
  for (const std::string method : {"stokes", "stokes-half"}) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const Real degree = std::abs(Real(out[i].s3)) / out[i].s0;
      // Sixty roundings of the angle, and 16 bits per number.
      EXPECT_CLOSE(degree, 1, 1e-6L + 8 * kUnit + (method == "stokes-half" ? 1e-3 * B::kPackingRoundings : 0))
          << method;
      EXPECT_EQ(out[i].s3 > 0, oracleStokes(chains[i])[3] > 0) << "handedness";
      EXPECT_LT(std::hypot(Real(out[i].s1), Real(out[i].s2)) / out[i].s0,
                60 * kUnit + (method == "stokes-half" ? 1e-3 * B::kPackingRoundings : 0));
    }
  }
  // Without S3 each reflection keeps cos 45 degrees of S2, so that half of the polarization remains instead of none.
  for (const auto& o : B::chains("stokes-linear", chains))
    EXPECT_CLOSE(std::hypot(Real(o.s1), Real(o.s2)) / o.s0, 0.5, 60 * kUnit);
}

}  // namespace
}  // namespace malus::test
