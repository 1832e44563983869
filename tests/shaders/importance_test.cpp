// Importance vectors against Stokes vectors: their product is the same at every step of a path.
#include "tests/shaders/chains.h"

namespace malus::test {
namespace {

using oracle::Real;

MALUS_OPTICS_SUITE(ImportanceTest);

template <class O, class ImportanceVector>
Real weighed(const ImportanceVector& r, const typename O::Stokes& s) {
  return Real(r.w) * s.s0.x + Real(r.q) * s.s1.x + Real(r.u) * s.s2.x + Real(r.v) * s.s3.x;
}

TYPED_TEST(ImportanceTest, EveryStepPreservesTheProductWithStokes) {
  MALUS_TYPES;
  Draw draw(130);
  Worst turned("turned", double(kEps)), met("met", double(kEps));
  for (int i = 0; i < 5000; ++i) {
    const oracle::Vec p = draw.direction(), q = draw.direction();
    const typename O::ImportanceVector row{1, R(p[0]), R(p[1]), R(p[2])};
    typename O::Stokes light = O::stokesUnpolarized(O::splat3(1));
    light.s1 = O::splat3(R(q[0]));
    light.s2 = O::splat3(R(q[1]));
    light.s3 = O::splat3(R(q[2]));
    // In a rotated frame both rotate and the product stays.
    const Real angle = draw.between(0, 6.3);
    const real c = R(std::cos(angle)), s = R(std::sin(angle));
    turned.add(weighed<O>(O::rotateImportance(row, c, s), O::rotateStokes(light, c, s)) - weighed<O>(row, light));
    // At an interface: (row M) S = row (M S).
    const Metal& m = kMetals[draw.below(5)];
    const auto f = draw.below(2) == 0 ? O::conductorReflectance(R(draw.unit()), 1, R(m.n[0]), R(m.k[0]))
                                      : O::dielectricReflectance(R(draw.unit()), R(1.5L), 1);
    const auto reflected =
        O::stokesInterface(light, O::splat3(f.rs), O::splat3(f.rp), O::splat3(f.xRe), O::splat3(f.xIm));
    met.add(weighed<O>(O::applyInterfaceTransposed(row, f.rs, f.rp, f.xRe, f.xIm), light) - weighed<O>(row, reflected));
  }
  EXPECT_LT(turned.value(), 8);
  EXPECT_LT(met.value(), 8);
}

TYPED_TEST(ImportanceTest, CrossedBrewsterMirrorsExtinguish) {
  MALUS_TYPES;
  // Brewster mirror, rotation by 90 degrees, Brewster mirror: w vanishes. All that follows stays that small.
  const auto f = O::dielectricReflectance(R(1 / std::sqrt(3.25L)), 1, R(1.5L));
  typename O::ImportanceVector row{1, 0, 0, 0};
  row = O::applyInterfaceTransposed(row, f.rs, f.rp, f.xRe, f.xIm);
  row = O::rotateImportance(row, -1, 0);
  row = O::applyInterfaceTransposed(row, f.rs, f.rp, f.xRe, f.xIm);
  EXPECT_CLOSE(row.w, 0, kEps);
  for (int i = 0; i < 5; ++i) {
    row = O::rotateImportance(row, R(0.6L), R(0.8L));
    const auto gold = O::conductorReflectance(R(0.7L), 1, R(0.1884L), R(3.4034L));
    row = O::applyInterfaceTransposed(row, gold.rs, gold.rp, gold.xRe, gold.xIm);
    for (const real v : {row.w, row.q, row.u, row.v}) EXPECT_CLOSE(v, 0, kEps);
  }
}

}  // namespace
}  // namespace malus::test
