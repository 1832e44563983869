// Brewster's angle: r_p vanishes as a difference of nearly equal numbers, and two mirrors can extinguish light.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(Brewster);

constexpr Real kPi = 3.14159265358979323846L;

TYPED_TEST(Brewster, NearBrewsterAngle) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const double n : {1.1, 1.33, 1.5, 2.42, 4.0, 1 / 1.5})
    for (const Real off : {0.0L, 1e-7L, -1e-7L, 1e-6L, -1e-6L, 1e-4L, -1e-4L})
      in.push_back({R(std::cos(std::atan(Real(n)) + off)), 1, R(n), 0, B::splat3(0)});
  const auto out = B::surfaces(in);
  for (std::size_t i = 0; i < in.size(); ++i) {
    // The cosine is rounded, so that r_p is not exactly 0: the bound is absolute, 2 eps.
    const oracle::Powers want = oracle::powers(in[i].c, 1, Real(in[i].n2));
    EXPECT_CLOSE(out[i].dielectric.rp, want.rp, 2 * kUnit) << in[i].c;
    EXPECT_CLOSE(out[i].dielectric.xRe, want.x.real(), 2 * kUnit) << in[i].c;
    EXPECT_CLOSE(out[i].dielectric.rs / want.rs, 1, 6 * kUnit) << in[i].c;
    EXPECT_CLOSE(out[i].transmittance.tp, want.tp, 3 * kUnit) << in[i].c;
  }
}

// Two glass mirrors at Brewster's angle, the second rotated by `twist` about the ray between them, then `more`.
Path crossed(Draw& draw, Real twist, const std::vector<Bounce>& more = {}) {
  Path path;
  path.d.push_back(draw.direction());
  const Real c = 1 / std::sqrt(3.25L), s = std::sqrt(1 - c * c);
  const Vec across = oracle::anyAcross(path.d[0]);
  extend(path, glassMirror(), oracle::along(path.d[0], -c, across, s));
  const Vec d = path.d[1], inPlane = oracle::cross(oracle::cross(path.d[0], across), d);
  const Vec rotated =
      oracle::along(oracle::unit(inPlane), std::cos(twist), oracle::cross(d, oracle::unit(inPlane)), std::sin(twist));
  extend(path, glassMirror(), oracle::along(d, -c, rotated, s));
  for (const Bounce& b : more) extend(path, b, normalAt(draw, path.d.back(), 0.6L));
  return path;
}

TYPED_TEST(Brewster, MalussLaw) {
  MALUS_BACKEND_TYPES;
  Draw draw(102);
  std::vector<typename B::ChainIn> chains;
  for (int degrees = 0; degrees <= 90; degrees += 5)
    for (int i = 0; i < 20; ++i) chains.push_back(chainFromPath<B>(crossed(draw, degrees * kPi / 180)));
  const Real rs = 25 / 169.0L, parallel = rs * rs / 2;  // ((n^2 - 1)/(n^2 + 1))^2 at n = 1.5
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const Real cosine = std::cos(static_cast<Real>(i / 20) * 5 * kPi / 180), got = out[i].s0;
      // Malus's law; the rounding of a mirror's normal rotates its plane by eps. Packing changes S1/S0 by 1/32767 and
      // S0 by 1/1024 behind each mirror; with less than IEEE's precision, the source's root 1 by half of that too.
      if (carriesStokes(method) || method == "sp-malus") {
        EXPECT_CLOSE(
            got / parallel, cosine * cosine,
            24 * kUnit +
                (method == "stokes-half" ? 2e-3 * B::kPackingRoundings + 1e-3 * (B::kPackingRoundings - 1) : 0))
            << method;
        // Extinct, to 1e-6 of the parallel case; in 16 bits to the rounding of S1 close to S0.
        if (i >= 18 * 20) {
          EXPECT_LT(std::abs(got), (method == "stokes-half" ? 6e-5L * B::kPackingRoundings : 1e-6L) * parallel)
              << method;
        }
      } else if (method == "fresnel") {
        EXPECT_CLOSE(got / parallel, 0.5, 12 * kUnit) << "the same at every angle";
      } else if (method == "sp") {
        EXPECT_CLOSE(got / parallel, std::abs(cosine), 24 * kUnit) << "|cos| instead of cos^2";
      } else {
        EXPECT_TRUE(std::isfinite(got) && got >= 0) << method;
      }
    }
  }
}

TYPED_TEST(Brewster, BouncesAfterExtinction) {
  MALUS_BACKEND_TYPES;
  Draw draw(103);
  // The rest is rounding error of any sign and polarization: it must stay that small and never become NaN.
  const std::vector<std::vector<Bounce>> more = {
      {glassMirror()},
      {metalMirror(kMetals[0]), metalMirror(kMetals[3])},
      {metalMirror(kMetals[0]), glassMirror(), metalMirror(kMetals[1]), glassMirror(), metalMirror(kMetals[2])}};
  std::vector<typename B::ChainIn> chains;
  for (int i = 0; i < 200; ++i) {
    // The extinguishing pair is the last one that the light meets (at the camera) or the first (at the source).
    Path path = crossed(draw, kPi / 2, more[static_cast<std::size_t>(i % 3)]);
    chains.push_back(chainFromPath<B>(path, i % 2 == 0 ? 1 : 1e6));
    // The same interfaces in reverse order.
    Path back;
    back.d.push_back(oracle::along(path.d.back(), -1, path.d.back(), 0));
    for (std::size_t j = path.bounces.size(); j-- > 0;) extend(back, path.bounces[j], path.bounces[j].n);
    chains.push_back(chainFromPath<B>(back));
  }
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      for (const Real v : stokesVector(out[i])) ASSERT_TRUE(std::isfinite(v)) << method;
      const Real radiance = chains[i].radiance;
      EXPECT_GT(out[i].s0, -8 * kUnit * radiance) << method;
      if (carriesStokes(method)) {
        const Real allowed = (30 * kUnit + (method == "stokes-half" ? 1e-4 * B::kPackingRoundings : 0)) * radiance;
        EXPECT_LT(largestDifference(stokesVector(out[i]), oracleStokes(chains[i])), allowed) << method << ' ' << i;
      }
    }
  }
}

}  // namespace
}  // namespace malus::test
