// Comparison of one interface with the Jones oracle on the same rounded inputs.
#pragma once

#include "tests/hard_cases/backends.h"
#include "tests/shaders/conditioned.h"

namespace malus::test {

// Expects every number of an interface within `roundings` times eps, times the factor by which the backend's arithmetic
// may be worse, of the oracle: relative to R_s where it is small, absolute to 1 for transmittances.
template <class B>
void expectSurface(const typename B::SurfaceIn& in, const typename B::SurfaceOut& out, double roundings,
                   PowersFunction powers = oracle::powers) {
  using oracle::Complex;
  using oracle::Real;
  constexpr Real kEps = std::numeric_limits<typename B::real>::epsilon();
  const Real unit = roundings * B::kRoundings * kEps;
  const Real c = std::min(Real(1), std::max(Real(0), Real(in.c)));
  const auto where = [&] {
    return ::testing::Message() << B::kBackend << ": cosine " << in.c << ", " << in.n1 << " to " << in.n2 << " - i "
                                << in.k2;
  };
  const auto expectNear = [&](Real got, Real want, Real spread, Real size, const char* what) {
    ASSERT_TRUE(std::isfinite(got)) << where() << ": " << what;
    EXPECT_LE(std::abs(got - want), unit * size + spread) << where() << ": " << what << " " << got << ", not " << want;
  };
  const auto expectMirror = [&](const auto& r, const Conditioned& o, const char* what) {
    expectNear(r.rs, o.value.rs, o.spread.rs, o.value.rs, what);
    expectNear(r.rp, o.value.rp, o.spread.rp, std::max(o.value.rs, o.value.rp), what);
    expectNear(std::abs(Complex(r.xRe, r.xIm) - o.value.x), 0, std::abs(o.spread.x), o.value.rs, what);
    EXPECT_TRUE(r.rs >= 0 && r.rs <= 1 && r.rp >= 0 && r.rp <= 1) << where() << ": " << what;
  };
  const Conditioned d = conditioned(c, in.n1, Real(in.n2), 3 * B::kRoundings * kEps, powers);
  expectMirror(out.dielectric, d, "dielectric");
  expectMirror(out.conductor, conditioned(c, in.n1, Complex(in.n2, -Real(in.k2)), 3 * B::kRoundings * kEps, powers),
               "conductor");
  // Denormals, which a device may flush; T is 4 c t/(c + t)^2, where t^2 is |eta^2 - 1| at least.
  const Real eta = Real(in.n2) / in.n1, weakest = in.n1 == in.n2 ? Real(1) : std::min(Real(1), std::abs(eta * eta - 1));
  const Real tiny = 16 * std::numeric_limits<typename B::real>::min() / weakest;
  expectNear(out.transmittance.ts, d.value.ts, d.spread.ts + tiny, std::max(d.value.ts, d.value.tp), "T_s");
  expectNear(out.transmittance.tp, d.value.tp, d.spread.tp + tiny, std::max(d.value.ts, d.value.tp), "T_p");
  expectNear(out.transmittance.x, d.value.txGeo, d.spread.txGeo + tiny, std::max(d.value.ts, d.value.tp),
             "sqrt(T_s T_p)");
  EXPECT_TRUE(out.schlick >= 0 && out.schlick <= 1 + static_cast<typename B::real>(unit))
      << where() << " schlick " << out.schlick;
}

template <class B>
void expectSurfaces(const std::vector<typename B::SurfaceIn>& in, double roundings,
                    PowersFunction powers = oracle::powers) {
  const auto out = B::surfaces(in);
  for (std::size_t i = 0; i < in.size() && !::testing::Test::HasFatalFailure(); ++i)
    expectSurface<B>(in[i], out[i], roundings, powers);
}

// Returns the Stokes vector of a chain by the oracle, from the same rounded numbers.
template <class Chain>
oracle::Stokes4 oracleStokes(const Chain& chain) {
  oracle::Stokes4 s = expectedStokes(pathFromChain(chain), 1);
  for (oracle::Real& v : s) v *= chain.radiance;
  return s;
}
template <class Out>
oracle::Stokes4 stokesVector(const Out& o) {
  return {o.s0, o.s1, o.s2, o.s3};
}
template <class A>
oracle::Real largestDifference(const A& a, const A& b, std::size_t components = 4) {
  oracle::Real worst = 0;
  for (std::size_t i = 0; i < components; ++i) {
    const oracle::Real d = std::abs(a[i] - b[i]);
    worst = d <= worst ? worst : d;  // NaN stays
  }
  return worst;
}

inline bool carriesStokes(const std::string& method) { return method.starts_with("stokes"); }
// Error of a Stokes vector per bounce from packing to 16 bits, relative to its S0 (stokes_half.h).
template <class B>
double packingLoss(const std::string& method) {
  return method == "stokes-half" ? 1.5e-3 * B::kPackingRoundings : 0;
}

}  // namespace malus::test
