// Diffuse radiance and the highlight's lobe: energy, against integrals in long double.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;

MALUS_OPTICS_SUITE(SourcesTest);

TYPED_TEST(SourcesTest, LambertReflectsItsAlbedo) {
  MALUS_TYPES;
  // Radiance L into the hemisphere is the exitance pi L.
  const real3 l = O::lambertRadiance(O::make3(R(0.2L), R(0.5L), 1), O::make3(1, 10, R(0.5L)), O::splat3(R(0.9L)));
  const Real pi = std::acos(Real(-1));
  EXPECT_CLOSE(l.x * pi, 0.2L * 1 * 0.9L, 3 * kEps);
  EXPECT_CLOSE(l.y * pi, 0.5L * 10 * 0.9L, 3 * kEps * 5);
  EXPECT_CLOSE(l.z * pi, 1 * 0.5L * 0.9L, 3 * kEps);
}

TYPED_TEST(SourcesTest, PhongLobeIsNormalized) {
  MALUS_TYPES;
  const real3 mirror = O::make3(0, 0, 1);
  for (const int exponent : {0, 1, 10, 200, 4095}) {
    // Integral over the hemisphere about the mirror direction, in z = cos, by the midpoint rule.
    constexpr int kSteps = 20000;
    Real sum = 0;
    for (int i = 0; i < kSteps; ++i) {
      // Steps grow quadratically toward the peak.
      const Real u = (i + 0.5L) / kSteps, z = 1 - u * u, width = 2 * u / kSteps;
      const real c = R(z), s = R(std::sqrt(1 - z * z));
      sum += O::phongLobe(mirror, O::make3(s, 0, c), exponent) * width;
    }
    sum *= 2 * std::acos(Real(-1));
    // The midpoint rule, and a power's error: half an eps for each unit of the exponent.
    EXPECT_CLOSE(sum, 1, 1e-5 + exponent * double(kEps)) << exponent;
  }
}

TYPED_TEST(SourcesTest, PhongLobeIsZeroBehindTheMirrorDirection) {
  MALUS_TYPES;
  EXPECT_EQ(O::phongLobe(O::make3(0, 0, 1), O::make3(0, R(0.6L), R(-0.8L)), 5), 0);
  EXPECT_EQ(O::phongLobe(O::make3(0, 0, 1), O::make3(1, 0, 0), 5), 0);
  EXPECT_CLOSE(O::phongLobe(O::make3(0, 0, 1), O::make3(0, 0, 1), 5), 3 / std::acos(Real(-1)), 2 * kEps);
}

}  // namespace
}  // namespace malus::test
