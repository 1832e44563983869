// Indices that nearly match, where differences cancel, and indices far from 1, where one square absorbs the other.
#include "tests/hard_cases/oracle_checks.h"

namespace malus::test {
namespace {

using oracle::Real;

MALUS_HARD_CASES(IndexMatch);

template <class real>
std::vector<real> cosines() {
  std::vector<real> list = {0, std::numeric_limits<real>::min(), real(1e-6), std::nextafter(real(1), real(0)), 1};
  for (int i = 1; i < 100; ++i) list.push_back(static_cast<real>(i) / 100);
  return list;
}

// Fresnel's equations where the oracle's own differences lose what long double has over double: by Snell's law
// n1^2 c^2 - n2^2 cosT^2 = n1^2 - n2^2, and r_p/r_s = cos(i + t)/cos(i - t).
oracle::Powers closedForm(Real c, Real n1, oracle::Complex complex) {
  const Real n2 = complex.real(), difference = (n2 - n1) * (n2 + n1), squared = difference + n1 * n1 * c * c;
  if (squared < 0) {
    oracle::Powers p = oracle::powers(c, n1, n2);  // total reflection: no difference of that kind
    return p;
  }
  const Real root = std::sqrt(squared), sum = n1 * c + root;  // root: n2 cosT
  const Real rs = sum > 0 ? -difference / (sum * sum) : -1;
  const Real sinSin = n1 * (1 - c) * (1 + c), cosCos = c * root;
  const Real ratio = (sinSin - cosCos) / (sinSin + cosCos);
  oracle::Powers p{rs * rs, rs * rs * ratio * ratio, rs * rs * ratio, 0, 0, 0};
  const Real sumP = n2 * n2 * c + n1 * root;
  p.ts = 4 * n1 * c * root / (sum * sum);
  p.tp = 4 * n1 * n2 * n2 * c * root / (sumP * sumP);
  p.txGeo = std::sqrt(p.ts * p.tp);
  return p;
}

TYPED_TEST(IndexMatch, IndexMatchReflectsNothing) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const real c : cosines<real>())
    for (const double n : {1e-3, 1.0, 1.5168, 1e3}) in.push_back({c, R(n), R(n), 0, B::splat3(0)});
  for (const auto& o : B::surfaces(in)) {
    EXPECT_EQ(o.dielectric.rs, 0);
    EXPECT_EQ(o.dielectric.rp, 0);
    EXPECT_EQ(o.conductor.rs, 0);
    EXPECT_EQ(o.conductor.xRe, 0);
    EXPECT_EQ(o.transmittance.ts, 1);
    EXPECT_EQ(o.transmittance.x, 1);
  }
}

TYPED_TEST(IndexMatch, NearMatchKeepsRelativeAccuracy) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const real c : cosines<real>()) {
    for (const auto& [n1, n2] : {std::pair(1.0, 1 + 1e-7),
                                 {1.0, 1 - 1e-7},
                                 {1 + 1e-7, 1.0},
                                 {1.5168, 1.5167},
                                 {1.5167, 1.5168},
                                 {1.0, 1.0001},
                                 {1.0001, 1.0}})
      if (R(n1) != R(n2)) in.push_back({c, R(n1), R(n2), 0, B::splat3(0)});
    // One step of the type.
    in.push_back({c, 1, std::nextafter(real(1), real(2)), 0, B::splat3(0)});
    in.push_back({c, R(1.5), std::nextafter(R(1.5), real(0)), 0, B::splat3(0)});
  }
  // (n2 - n1)(n2 + n1) is as exact as the rounded indices themselves: relative, although R_s is 1e-15.
  expectSurfaces<B>(in, 8, closedForm);
}

TYPED_TEST(IndexMatch, ExtremeIndexRatios) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const real c : cosines<real>())
    for (const double n1 : {1e-3, 1.0, 1.5, 1e3})
      for (const double n2 : {1e-3, 0.05, 0.5, 10.0, 1e3})
        for (const double k2 : {0.0, 1e-8, 1e-3, 1.0, 1e3})
          if (n1 != n2) in.push_back({c, R(n1), R(n2), R(k2), B::splat3(0)});
  expectSurfaces<B>(in, 16);
}

TYPED_TEST(IndexMatch, MetalWithoutAbsorptionIsADielectric) {
  MALUS_BACKEND_TYPES;
  std::vector<typename B::SurfaceIn> in;
  for (const real c : cosines<real>())
    for (const auto& [n1, n2] : {std::pair(1.0, 1.5), {1.5, 1.0}, {1.5168, 1.5167}, {1.0, 2.42}})
      for (const double k2 : {0.0, 1e-8}) in.push_back({c, R(n1), R(n2), R(k2), B::splat3(0)});
  expectSurfaces<B>(in, 12);
}

TYPED_TEST(IndexMatch, VacuumInsideGlassInsideWater) {
  MALUS_BACKEND_TYPES;
  Draw draw(105);
  // Water, glass, a bubble, glass, water: refraction at parallel and tilted faces.
  std::vector<typename B::ChainIn> chains;
  while (chains.size() < 400) {
    Path path;
    path.d.push_back(draw.direction());
    oracle::Vec n = normalAt(draw, path.d[0], draw.between(0.75, 0.98));
    bool passes = true;
    for (const auto& [n1, n2] : {std::pair(1.33, 1.5), {1.5, 1.0}, {1.0, 1.5}, {1.5, 1.33}}) {
      const Real c = std::abs(oracle::dot(path.d.back(), n)), sinT = n1 / n2 * std::sqrt(1 - c * c);
      passes = passes && sinT < 0.95L;  // further on the critical angle magnifies
      if (passes) extend(path, glassWindow(n1, n2), n);
      n = oracle::unit(oracle::along(n, 1, draw.direction(), chains.size() % 2 == 0 ? 0 : 0.1L));
    }
    if (passes) chains.push_back(chainFromPath<B>(path));
  }
  for (const std::string method : {"stokes", "stokes-linear", "stokes-half"}) {
    const auto out = B::chains(method, chains);
    for (std::size_t i = 0; i < chains.size(); ++i)
      EXPECT_LT(largestDifference(stokesVector(out[i]), oracleStokes(chains[i])),
                100 * kUnit + 4 * packingLoss<B>(method))
          << method;  // four windows, each magnifies the directions' roundings by up to 1/.3
  }
}

}  // namespace
}  // namespace malus::test
