// A million draws of interfaces and lights with a fixed seed: properties that hold for all.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_HARD_CASES(RandomDraws);

TYPED_TEST(RandomDraws, AMillionInterfaces) {
  MALUS_BACKEND_TYPES;
  constexpr std::size_t kBatch = B::kInterfaces / 8;
  Draw draw(114);
  Worst sum("sum", kUnit), back("reciprocity", kUnit), excess("excess", kUnit), negative("negative", kUnit);
  for (int batch = 0; batch < 8; ++batch) {
    std::vector<typename B::SurfaceIn> in;
    in.reserve(kBatch);
    const auto decades = [&](double low, double high) { return std::pow(10.0L, draw.between(low, high)); };
    for (std::size_t i = 0; i < kBatch; ++i) {
      const Real c = i % 4 == 0 ? decades(-8, 0) : i % 4 == 1 ? 1 - decades(-8, 0) : draw.unit();
      const Real n1 = i % 3 == 0 ? 1 : draw.between(1, 2.5), n2 = i % 5 == 0 ? decades(-3, 3) : draw.between(0.1, 4);
      const Real k2 = i % 3 == 0 ? 0 : i % 3 == 1 ? draw.between(0, 5) : decades(-8, 3);
      // From unpolarized to fully polarized but for its own rounding.
      const Real degree = i % 2 == 0 ? 1 - 2 * Real(kEps) : Real(draw.unit());
      const Vec p = draw.direction();
      in.push_back({R(c), R(n1), R(n2), R(k2), toReal3<B>(oracle::along(p, degree, p, 0))});
    }
    const auto out = B::surfaces(in);
    for (std::size_t i = 0; i < kBatch; ++i) {
      const auto& o = out[i];
      const auto where = [&] {
        return ::testing::Message() << in[i].c << ' ' << in[i].n1 << ' ' << in[i].n2 << ' ' << in[i].k2;
      };
      for (const real v : {o.dielectric.rs, o.dielectric.rp, o.conductor.rs, o.conductor.rp, o.transmittance.ts,
                           o.transmittance.tp, o.transmittance.x})
        ASSERT_TRUE(v >= 0 && v <= 1) << where();
      // R + T = 1 for s and for p.
      sum.add(Real(o.dielectric.rs) + o.transmittance.ts - 1);
      sum.add(Real(o.dielectric.rp) + o.transmittance.tp - 1);
      // The same transmittances from the other side, along the refracted ray. Its cosine is off by a rounding over
      // t^2; the return magnifies that by t^2 over the cosine outside squared.
      if (o.total == 0 && o.t > 0 && in[i].c > R(1e-3L)) {
        const Real t = o.t, c = in[i].c, magnified = 1 + t * t / (c * c) + 1 / (t * t);
        back.add((Real(o.transmittance.ts) - o.back.ts) / magnified);
        back.add((Real(o.transmittance.tp) - o.back.tp) / magnified);
      }
      // S0 >= |S|, but for 4 eps of the mean reflectance.
      const auto physical = [&](const auto& a, const auto& b, Real mean) {
        const Real s0 = a.x, p = std::sqrt(Real(a.y) * a.y + Real(a.z) * a.z + Real(b.x) * b.x);
        ASSERT_TRUE(std::isfinite(s0) && std::isfinite(p)) << where();
        if (mean <= 0) return;
        excess.add(std::max(Real(0), p - s0) / mean);
        negative.add(std::min(Real(0), s0) / mean);
      };
      physical(o.reflected0, o.reflected1, (Real(o.dielectric.rs) + o.dielectric.rp) / 2);
      physical(o.metal0, o.metal1, (Real(o.conductor.rs) + o.conductor.rp) / 2);
      physical(o.through0, o.through1, (Real(o.transmittance.ts) + o.transmittance.tp) / 2);
      if (::testing::Test::HasFatalFailure()) return;
    }
  }
  EXPECT_LT(sum.value(), 8);
  EXPECT_LT(back.value(), 8);
  EXPECT_LT(excess.value(), 4);
  EXPECT_LT(negative.value(), 4);
}

TYPED_TEST(RandomDraws, RotationInvariance) {
  MALUS_BACKEND_TYPES;
  Draw draw(115);
  // The same path, rotated as a whole: S0, the degrees of linear and of circular polarization stay the same.
  // Directions and normals are rounded differently, which the path magnifies: the oracle, applied to both, gives the
  // amount.
  std::vector<typename B::ChainIn> plain, turned;
  for (int i = 0; i < 3000; ++i) {
    const Path path = randomPath(draw, 1 + draw.below(6));
    const Vec a = draw.direction(), b = oracle::unit(oracle::cross(a, draw.direction())), c = oracle::cross(a, b);
    const auto turn = [&](const Vec& v) -> Vec { return {oracle::dot(a, v), oracle::dot(b, v), oracle::dot(c, v)}; };
    Path other;
    other.d.push_back(turn(path.d[0]));
    for (std::size_t k = 0; k < path.bounces.size(); ++k) extend(other, path.bounces[k], turn(path.bounces[k].n));
    plain.push_back(chainFromPath<B>(path));
    turned.push_back(chainFromPath<B>(other));
  }
  const auto seen = [](const oracle::Stokes4& s) { return std::array<Real, 3>{s[0], std::hypot(s[1], s[2]), s[3]}; };
  for (const std::string& method : everyMethod()) {
    const auto a = B::chains(method, plain), b = B::chains(method, turned);
    for (std::size_t i = 0; i < plain.size(); ++i) {
      const auto x = seen(stokesVector(a[i])), y = seen(stokesVector(b[i]));
      const auto ox = seen(oracleStokes(plain[i])), oy = seen(oracleStokes(turned[i]));
      const Real size = std::max(unpolarizedShare(pathFromChain(plain[i]), 1), Real(1e-3L));
      // A cosine rotates s by up to 7e-4 per ray in float; 16 bits per number cost 1.5e-3,
      // in each of up to seven rays of both paths, in different directions.
      const Real coarse =
          method == "sp-cosine" || method == "sp-ratio" ? 12 * std::sqrt(kUnit) : 8 * packingLoss<B>(method);
      for (std::size_t k = 0; k < 3; ++k)
        EXPECT_LT(std::abs(x[k] - y[k]), (300 * kUnit + coarse) * size + 4 * std::abs(ox[k] - oy[k]))
            << method << ' ' << i << ' ' << k;
      if (::testing::Test::HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace malus::test
