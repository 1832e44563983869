// Schlick's approximation against its formula and against the exact mean.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Complex;
using oracle::Real;

MALUS_OPTICS_SUITE(SchlickTest);

TYPED_TEST(SchlickTest, EqualsTheFormula) {
  MALUS_TYPES;
  Worst worst("schlick", double(kEps));
  const auto compare = [&](real c, real n1, real n2, real k) {
    const Complex index(n2, -k);
    const Real f0 = std::norm((index - Real(n1)) / (index + Real(n1)));
    Real cosine = c;
    if (n2 < n1 && k == 0) {
      const Real sinT = n1 / Real(n2) * std::sqrt((1 - Real(c)) * (1 + Real(c)));
      if (sinT > 0.99L) return;  // the root magnifies there; its end is tested below
      cosine = std::sqrt((1 - sinT) * (1 + sinT));
    }
    worst.add(O::schlickReflectance(c, n1, n2, k) - (f0 + (1 - f0) * std::pow(1 - cosine, 5)));
  };
  for (int i = 0; i <= 1000; ++i) {
    const real c = static_cast<real>(i) / 1000;
    for (const double n : {1.33, 1.5, 2.42}) {
      compare(c, 1, R(n), 0);
      compare(c, R(n), 1, 0);
    }
    for (const Metal& m : kMetals) compare(c, 1, R(m.n[0]), R(m.k[0]));
  }
  EXPECT_LT(worst.value(), 20);  // absolute; inside glass near the critical angle the root magnifies up to 7 times
}

TYPED_TEST(SchlickTest, ExactAtNormalIncidenceAndOneAtGrazing) {
  MALUS_TYPES;
  EXPECT_CLOSE(O::schlickReflectance(1, 1, R(1.5L), 0), 0.04L, kEps);
  EXPECT_CLOSE(O::schlickReflectance(1, R(1.5L), 1, 0), 0.04L, kEps);
  for (const Metal& m : kMetals)
    EXPECT_CLOSE(O::schlickReflectance(1, 1, R(m.n[1]), R(m.k[1])),
                 O::conductorReflectance(1, 1, R(m.n[1]), R(m.k[1])).rs, 4 * kEps);
  EXPECT_CLOSE(O::schlickReflectance(0, 1, R(1.5L), 0), 1, kEps);
  EXPECT_CLOSE(O::schlickReflectance(0, 1, 2, 3), 1, kEps);
}

TYPED_TEST(SchlickTest, TotalReflectionIsOneAndEqualIndicesReflectNothing) {
  MALUS_TYPES;
  for (const double c : {0.0, 0.1, 0.5, 0.7}) EXPECT_EQ(O::schlickReflectance(R(c), R(1.5L), 1, 0), 1) << c;
  EXPECT_LT(O::schlickReflectance(R(0.8L), R(1.5L), 1, 0), 1);
  for (const double c : {0.5, 1.0}) EXPECT_LT(O::schlickReflectance(R(c), R(1.5L), R(1.5L), 0), 0.04);
  // With absorption there is no total reflection: the incident cosine counts.
  EXPECT_LT(O::schlickReflectance(R(0.5L), 1, R(0.2L), 3), 1);
}

TYPED_TEST(SchlickTest, StaysNearTheExactMean) {
  MALUS_TYPES;
  // For glass from outside Schlick is known to be within some hundredths.
  for (int i = 0; i <= 100; ++i) {
    const real c = static_cast<real>(i) / 100;
    const auto exact = O::dielectricReflectance(c, 1, R(1.5L));
    EXPECT_CLOSE(O::schlickReflectance(c, 1, R(1.5L), 0), (exact.rs + exact.rp) / 2, 0.04) << c;
  }
}

}  // namespace
}  // namespace malus::test
