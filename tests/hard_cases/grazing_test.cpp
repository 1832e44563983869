// Grazing incidence: everything is reflected, and cosines may be 0, denormal or, by rounding, negative.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;

MALUS_HARD_CASES(Grazing);

TYPED_TEST(Grazing, CosineZeroDenormalAndNegative) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const real c : {real(0), std::numeric_limits<real>::denorm_min(), std::numeric_limits<real>::min(), R(1e-30L),
                       R(1e-7L), R(1e-4L), -std::numeric_limits<real>::min(), R(-1e-7L), R(-1e-3L)})
    for (const auto& [n1, n2, k2] : {std::tuple(1.0, 1.5, 0.0),
                                     {1.5, 1.0, 0.0},
                                     {1.0, 1.0001, 0.0},
                                     {1.0, 4.0, 0.0},
                                     {1.0, 0.1884, 3.4034},
                                     {1.33, 2.8924, 3.0655},
                                     {1.0, 0.0, 2.0},
                                     {1.0, 1e3, 1e3}})
      in.push_back({c, R(n1), R(n2 == 0 ? 1e-3 : n2), R(k2), B::splat3(0)});
  expectSurfaces<B>(in, 12);
  const auto out = B::surfaces(in);
  for (std::size_t i = 0; i < in.size(); ++i)
    if (in[i].c <= 0) {
      // A hit clamps the cosine to 0, where R = 1, T = 0 and r_p = r_s = -1.
      EXPECT_CLOSE(out[i].dielectric.rs, 1, 3 * kUnit);
      EXPECT_CLOSE(out[i].dielectric.rp, 1, 3 * kUnit);
      EXPECT_CLOSE(out[i].dielectric.xRe, 1, 3 * kUnit);
      EXPECT_EQ(out[i].transmittance.ts, 0);
      EXPECT_EQ(out[i].transmittance.tp, 0);
    }
}

TYPED_TEST(Grazing, DirectionsStayNormalized) {
  MALUS_BACKEND_TYPES;
  Draw draw(104);
  std::vector<typename B::FrameIn> in;
  for (int i = 0; i < 2000; ++i) {
    const oracle::Vec n = draw.direction(), across = oracle::anyAcross(n);
    const Real c = i % 4 == 0 ? 0 : std::pow(10.0L, -draw.between(0, 40)) * (i % 4 == 1 ? -1 : 1);
    in.push_back(
        {toReal3<B>(oracle::unit(oracle::along(across, 1, n, -c))), toReal3<B>(n), 1, R(i % 2 == 0 ? 1.5 : 0.9)});
  }
  const auto out = B::frames(in);
  for (std::size_t i = 0; i < in.size(); ++i) {
    for (const auto& v : {out[i].mirror, out[i].refracted, out[i].s})
      EXPECT_CLOSE(oracle::dot(toVec(v), toVec(v)), 1, 6 * kUnit);
    EXPECT_CLOSE(oracle::dot(toVec(out[i].s), toVec(in[i].d)), 0, 4 * kUnit);
    EXPECT_CLOSE(oracle::dot(toVec(out[i].s), toVec(out[i].mirror)), 0, 12 * kUnit);
  }
}

}  // namespace
}  // namespace malus::test
