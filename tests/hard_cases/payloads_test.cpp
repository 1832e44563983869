// Payloads at the limits of their encoding: cosines near 1, ratios with a zero denominator, 16 bits for six decades.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(Payloads);

TYPED_TEST(Payloads, EveryMethodReceivesEveryState) {
  MALUS_BACKEND_TYPES;
  Draw draw(112);
  // Directions of s: the canonical axes exactly, a few roundings off them, and any.
  std::vector<typename B::HandOverIn> in;
  for (const Vec& d : {Vec{0, 0, -1}, Vec{0, 0, 1}, Vec{1, 0, 0}, Vec{0, -1, 0}, draw.direction(), draw.direction()}) {
    const Vec back = oracle::along(d, -1, d, 0), x = oracle::canonicalX(back), y = oracle::cross(back, x);
    for (const Real angle :
         {0.0L, 1e-8L, -1e-8L, 1e-4L, -1e-4L, 0.7L, 1.5707963267948966L, 1.5707963L, 3.14159265L, -0.4L})
      for (const Vec& light : {Vec{0, 0, 0}, Vec{1, 0, 0}, Vec{-1, 0, 0}, Vec{0, 1, 0}, Vec{0, 0, 1},
                               Vec{0.6L, 0, -0.8L}, Vec{-1 + 1e-7L, 0, 0}, Vec{1 - 1e-7L, 0, 0}})
        for (const Vec& radiance :
             {Vec{0, 0, 0}, Vec{1, 1, 1}, Vec{0, 1, 0}, Vec{1e-6L, 1, 1e6L}, Vec{1e-30L, 1e30L, 1}}) {
          const Vec s = oracle::unit(oracle::along(x, std::cos(angle), y, std::sin(angle)));
          in.push_back({toReal3<B>(d), toReal3<B>(s), toReal3<B>(s), toReal3<B>(light), toReal3<B>(radiance)});
        }
  }
  for (const std::string& method : everyMethod()) {
    const auto out = B::handOvers(method, in);
    for (std::size_t i = 0; i < in.size(); ++i)
      for (int c = 0; c < 3; ++c) {
        const Real sent = in[i].radiance[c], arrived = out[i].s0[c];
        for (const Real v :
             {arrived, Real(out[i].s1[c]), Real(out[i].s2[c]), Real(out[i].s3[c]), Real(out[i].received[c])})
          ASSERT_TRUE(std::isfinite(v)) << method << ' ' << i;
        if (method == "stokes-half") {
          // sqrt(S0) in half floats: 1 part in 1000 from 3.6e-9 to 4.3e9, where it saturates; below, steps of 3.6e-15.
          const Real kept = std::min(sent, Real(65504) * 65504);
          const Real flushed = B::kFlushesHalves && kept < 0x1p-28L ? kept : 0;
          EXPECT_LE(std::abs(arrived - kept),
                    B::kPackingRoundings * (1e-3L * kept + 1e-7L * std::sqrt(kept) + 4e-15L) + flushed)
              << i;
          EXPECT_LE(std::hypot(std::hypot(Real(out[i].s1[c]), Real(out[i].s2[c])), Real(out[i].s3[c])),
                    arrived * (1 + 8 * kUnit));
          continue;
        }
        // One ratio for three colours is exact where their light is polarized alike, as here; the ratio's own
        // rounding is that of a quotient.
        EXPECT_CLOSE(arrived / (sent > 0 ? sent : 1), sent > 0 ? 1 : 0, 12 * kUnit) << method << ' ' << i;
        // A receiver with the sender's s gets all of it; |cos| of a direction that went through a cosine is off by
        // the root of a rounding, and so is its sine, which adds light.
        const bool cosine = method == "sp-cosine" || method == "sp-ratio";
        EXPECT_CLOSE(Real(out[i].received[c]) / (sent > 0 ? sent : 1), sent > 0 ? 1 : 0,
                     12 * kUnit + (cosine ? 4 * std::sqrt(kUnit) : 0))
            << method << ' ' << i;
      }
  }
}

TYPED_TEST(Payloads, RatioWithZeroS) {
  MALUS_BACKEND_TYPES;
  Draw draw(113);
  // All light along p: the ratio would be infinite. The powers are swapped and no light is lost.
  std::vector<typename B::HandOverIn> in;
  for (int i = 0; i < 200; ++i) {
    const Vec d = draw.direction(), s = oracle::unit(oracle::cross(d, draw.direction()));
    in.push_back({toReal3<B>(d), toReal3<B>(s), toReal3<B>(s), B::make3(-1, 0, 0), B::make3(R(0.1), R(0.2), R(0.3))});
  }
  const auto out = B::handOvers("sp-ratio", in), want = B::handOvers("sp", in);
  for (std::size_t i = 0; i < in.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      EXPECT_EQ(out[i].s0[c], in[i].radiance[c]);
      EXPECT_CLOSE(out[i].s1[c], want[i].s1[c], 4 * std::sqrt(kUnit));
      EXPECT_CLOSE(out[i].s2[c], want[i].s2[c], 4 * std::sqrt(kUnit));
    }
}

TYPED_TEST(Payloads, SixteenBitsWithInfinitiesAndZeros) {
  MALUS_BACKEND_TYPES;
  const real infinity = std::numeric_limits<real>::infinity(), nan = std::numeric_limits<real>::quiet_NaN();
  std::vector<typename B::HandOverIn> in;
  for (const real radiance : {real(0), infinity, nan, std::numeric_limits<real>::max(), real(1e-6), real(1e6), real(1),
                              std::numeric_limits<real>::denorm_min(), real(-1)})
    for (const auto& light : {B::make3(0, 0, 0), B::make3(1, 0, 0), B::make3(0, R(0.6L), R(-0.8L))})
      in.push_back({B::make3(0, 0, -1), B::make3(1, 0, 0), B::make3(1, 0, 0), light, B::splat3(radiance)});
  const auto out = B::handOvers("stokes-half", in);
  for (std::size_t i = 0; i < in.size(); ++i) {
    const Real s0 = out[i].s0.x, p = std::hypot(std::hypot(Real(out[i].s1.x), Real(out[i].s2.x)), Real(out[i].s3.x));
    ASSERT_TRUE(std::isfinite(s0) && std::isfinite(p) && std::isfinite(out[i].received.x)) << i;
    EXPECT_GE(s0, 0);
    EXPECT_LE(s0, Real(65504) * 65504) << "infinity saturates too";
    EXPECT_LE(p, s0 * (1 + 8 * kUnit));
  }
  // Values that differ by 1e6: both ends of the range keep three digits.
  EXPECT_CLOSE(out[12].s0.x / 1e-6, 1, 1.1e-3);
  EXPECT_CLOSE(out[15].s0.x / 1e6, 1, 1.1e-3);
  EXPECT_EQ(out[3].s0.x, real(65504) * real(65504));
}

}  // namespace
}  // namespace malus::test
