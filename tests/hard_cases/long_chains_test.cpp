// Long chains: roundings add up, and must neither create energy nor exceed full polarization.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(LongChains);

// 64 mirrors, each at `cosine`, the plane of incidence rotated by `twist` at every mirror.
Path mirrors(Draw& draw, const std::vector<Bounce>& kinds, std::size_t count, Real cosine, Real twist) {
  Path path;
  path.d.push_back(draw.direction());
  Vec s = oracle::anyAcross(path.d[0]);
  const Real sine = std::sqrt(1 - cosine * cosine);
  for (std::size_t i = 0; i < count; ++i) {
    const Vec d = path.d.back(), p = oracle::cross(d, s);
    const Vec rotated = oracle::unit(oracle::along(s, std::cos(twist), p, std::sin(twist)));
    // Normalize, or every reflection would double the error of the length.
    extend(path, kinds[i % kinds.size()], oracle::unit(oracle::along(d, -cosine, oracle::cross(d, rotated), sine)));
    // Both rays of a mirror have the same s; keep it perpendicular to the next ray.
    const Vec next = path.d.back();
    s = oracle::unit(oracle::along(rotated, 1, next, -oracle::dot(rotated, next)));
  }
  return path;
}

TYPED_TEST(LongChains, SixtyFourMirrors) {
  MALUS_BACKEND_TYPES;
  Draw draw(109);
  std::vector<typename B::ChainIn> chains;
  for (const Real cosine : {0.99L, 0.8L, 0.6L, 0.3L, 0.05L})
    for (const Real twist : {0.0L, 0.01L, 0.3L, 1.0L, 1.5707963267948966L})
      for (const auto& kinds : std::vector<std::vector<Bounce>>{{metalMirror(kMetals[0])},
                                                                {metalMirror(kMetals[1])},
                                                                {metalMirror(kMetals[0]), metalMirror(kMetals[3])},
                                                                {glassMirror(1.5, 1)},
                                                                {glassMirror(), metalMirror(kMetals[1])}}) {
        // Inside glass past the critical angle, where no light is lost; at the other cosines it is an ordinary chain.
        chains.push_back(chainFromPath<B>(mirrors(draw, kinds, 64, cosine, twist)));
      }
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    Worst error(method + "_error", kUnit);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      for (const Real v : stokesVector(out[i])) ASSERT_TRUE(std::isfinite(v)) << method;
      const Path path = pathFromChain(chains[i]);
      if (carriesStokes(method) && method != "stokes-linear") {
        // Directions drift by one rounding per mirror, so the i-th angle has an error of i roundings. Relative to the
        // result, or to the reflectance of an unpolarized chain, errors add up to count^2/2, magnified by 1/cos at
        // steep angles.
        const oracle::Stokes4 want = oracleStokes(chains[i]);
        const Real size = std::max(unpolarizedShare(path, 1), want[0]), steep = 1 / path.cosine(0);
        const Real off = largestDifference(stokesVector(out[i]), want) / size;
        // Half floats lose their bits below 1e-8 of the source and are 0 below 1e-15; floats end at 1e-38.
        const Real flushed = (method == "stokes-half" ? 1e-8L : 1e-36L) / size;
        const Real allowed = 64 * 64 * kUnit * steep + 64 * packingLoss<B>(method) + flushed;
        EXPECT_LT(off, allowed) << method << ' ' << i << " cosine " << static_cast<double>(path.cosine(0));
        if (method == "stokes") error.add(off / steep);
      }
      if (carriesStokes(method) || method == "fresnel" || method == "schlick" || method == "sp-malus") {
        EXPECT_LT(out[i].grown, 8 * kUnit + 2 * packingLoss<B>(method)) << method << ": a mirror makes light";
      }
      if (carriesStokes(method) || method == "sp-malus") {
        EXPECT_LT(out[i].gained, 6 * kUnit + packingLoss<B>(method)) << method << i << ": more than fully polarized";
      }
    }
    // The directions themselves stay unit.
    for (std::size_t i = 0; i < out.size(); ++i) {
      const Vec last = toVec(out[i].last);
      EXPECT_CLOSE(oracle::dot(last, last), 1, 4 * kUnit) << method << i;
    }
  }
}

TYPED_TEST(LongChains, GlassGoldGoldGlassNeedsCircularLight) {
  MALUS_BACKEND_TYPES;
  // The smallest chain in which S3 counts: two phase shifters strictly between two diattenuators.
  Draw draw(110);
  std::vector<typename B::ChainIn> chains;
  for (int i = 0; i < 200; ++i) {
    Path path;
    path.d.push_back(draw.direction());
    for (const Bounce& b : {glassMirror(), metalMirror(kMetals[0]), metalMirror(kMetals[0]), glassMirror()})
      extend(path, b, normalAt(draw, path.d.back(), b.metal ? draw.between(0.2, 0.5) : 1 / std::sqrt(3.25L)));
    chains.push_back(chainFromPath<B>(path));
  }
  const auto exact = B::chains("stokes", chains), linear = B::chains("stokes-linear", chains);
  Real largest = 0;
  for (std::size_t i = 0; i < chains.size(); ++i) {
    const oracle::Stokes4 want = oracleStokes(chains[i]);
    const Real size = unpolarizedShare(pathFromChain(chains[i]), 1);
    EXPECT_LT(largestDifference(stokesVector(exact[i]), want) / size, 200 * kUnit);
    largest = std::max(largest, std::abs(linear[i].s0 - want[0]) / size);
  }
  EXPECT_GT(largest, 0.05L) << "stokes-linear must differ here";
  ::testing::Test::RecordProperty("stokesLinearError", std::to_string(static_cast<double>(largest)));
}

TYPED_TEST(LongChains, RandomPathsStayPhysicalInEveryMethod) {
  MALUS_BACKEND_TYPES;
  Draw draw(111);
  std::vector<typename B::ChainIn> chains;
  for (int i = 0; i < 500; ++i)
    chains.push_back(chainFromPath<B>(randomPath(draw, 2 + draw.below(40)), i % 3 == 0 ? 1e4 : 1));
  for (const std::string& method : everyMethod()) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 0; i < chains.size(); ++i) {
      const Real radiance = chains[i].radiance;
      for (const Real v : stokesVector(out[i])) ASSERT_TRUE(std::isfinite(v)) << method;
      EXPECT_GT(out[i].s0, -4 * kUnit * radiance) << method;
      if (carriesStokes(method)) {
        EXPECT_LT(out[i].gained, 6 * kUnit + packingLoss<B>(method)) << method;
      }
    }
  }
}

}  // namespace
}  // namespace malus::test
