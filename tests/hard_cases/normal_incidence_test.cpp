// Normal incidence: the plane of incidence does not exist, and close to it the s direction depends on rounding.
// The reflected light must not depend on s.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(NormalIncidence);

constexpr Real kPi = 3.14159265358979323846L;

TYPED_TEST(NormalIncidence, Powers) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const Real below : {0.0L, 1e-7L, 1e-5L})
    for (const auto& [n1, n2, k2] : {std::tuple(1.0, 1.5, 0.0),
                                     {1.5, 1.0, 0.0},
                                     {1.0, 1.0001, 0.0},
                                     {1.0, 0.1884, 3.4034},
                                     {1.5, 2.8924, 3.0655},
                                     {1.0, 0.05, 0.0},
                                     {1.0, 1e3, 1e3}})
      in.push_back({R(1 - below), R(n1), R(n2), R(k2), B::splat3(0)});
  // About twenty roundings from the inputs to R of a metal.
  expectSurfaces<B>(in, 12);
  const auto out = B::surfaces(in);
  // At exactly normal incidence s and p cannot be distinguished.
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_CLOSE(out[i].dielectric.rs, out[i].dielectric.rp, kUnit * out[i].dielectric.rs);
    EXPECT_CLOSE(out[i].conductor.rs, out[i].conductor.rp, 8 * kUnit * out[i].conductor.rs);
    EXPECT_CLOSE(out[i].transmittance.ts, out[i].transmittance.tp, 4 * kUnit);
  }
}

// The camera looks perpendicularly at a metal, tilted by a tiny angle in a rotating direction; the ray that
// comes back meets glass at Brewster's angle, which makes its light fully polarized.
Path towardGlass(const Vec& d, Real tilt, Real azimuth) {
  const Vec u = oracle::anyAcross(d), v = oracle::cross(d, u);
  Path path;
  path.d.push_back(d);
  const Vec normal =
      oracle::unit(oracle::along(oracle::along(d, -1, u, tilt * std::cos(azimuth)), 1, v, tilt * std::sin(azimuth)));
  extend(path, metalMirror(kMetals[0]), normal);
  const Real c = 1 / std::sqrt(3.25L);  // Brewster's angle of n = 1.5, for the ray that returns exactly
  extend(path, glassMirror(), oracle::along(d, c, oracle::unit(oracle::along(u, 0.6L, v, 0.8L)), std::sqrt(1 - c * c)));
  return path;
}

TYPED_TEST(NormalIncidence, TheChoiceOfSDoesNotMatter) {
  MALUS_BACKEND_TYPES;
  Draw draw(101);
  std::vector<typename B::ChainIn> chains;
  constexpr int kTurns = 24;
  for (int i = 0; i < 12; ++i) {
    const Vec d = i < 6 ? Vec{i == 0   ? 1.0L
                              : i == 1 ? -1.0L
                                       : 0,
                              i == 2   ? 1.0L
                              : i == 3 ? -1.0L
                                       : 0,
                              i == 4   ? 1.0L
                              : i == 5 ? -1.0L
                                       : 0}
                        : draw.direction();
    for (const Real tilt : {0.0L, 1e-20L, 1e-16L, 1e-9L, 3e-8L, 1e-7L, 1e-6L, 1e-4L})
      for (int turn = 0; turn < kTurns; ++turn)
        chains.push_back(chainFromPath<B>(towardGlass(d, tilt, 2 * kPi * turn / kTurns)));
  }
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    Real worst = 0, low = 10, high = 0;
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const oracle::Stokes4 want = oracleStokes(chains[i]), got = stokesVector(out[i]);
      for (const Real v : got) ASSERT_TRUE(std::isfinite(v)) << method;
      // Brewster glass reflects .148 of s light: errors are relative to the recorded light.
      if (carriesStokes(method)) worst = std::max(worst, largestDifference(want, got) / want[0]);
      low = std::min(low, got[0] / want[0]);
      high = std::max(high, got[0] / want[0]);
    }
    ::testing::Test::RecordProperty(method + "_intensityLow", std::to_string(static_cast<double>(low)));
    ::testing::Test::RecordProperty(method + "_intensityHigh", std::to_string(static_cast<double>(high)));
    if (carriesStokes(method)) {
      // Two interfaces and four rotations, some forty roundings in a row; 16 bits per number cost more.
      // A metal tilted by 1e-4 delays p by about 1e-8, which stokes-linear drops.
      EXPECT_LT(worst, 20 * kUnit + 2 * packingLoss<B>(method) + (method == "stokes-linear" ? 1e-8L : 0)) << method;
    } else if (method == "sp" || method == "sp-cosine" || method == "sp-ratio") {
      // |cos| makes between 1 and 1.41 times the light, by the angle between an arbitrary s and the glass's.
      EXPECT_GT(high, 1.3) << method;
      EXPECT_LT(high, std::sqrt(2.0L) * (1 + (method == "sp" ? 20 * kUnit : 1e-3))) << method;
      EXPECT_GT(low, 1 - (method == "sp" ? 20 * kUnit : 1e-3)) << method;
    } else {
      // Methods without a direction of polarization: near normal incidence a metal does not polarize.
      EXPECT_LT(high - low, 2e-4) << method;
    }
  }
}

}  // namespace
}  // namespace malus::test
