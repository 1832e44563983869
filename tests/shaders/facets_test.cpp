// Rough surfaces and the clear sky: samples and formulas against integrals.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

constexpr double kPi = 3.14159265358979323846;

MALUS_OPTICS_SUITE(FacetsTest);

// Equal areas of the unit disk.
template <class Act>
void overDisk(int rings, Act act) {
  for (int i = 0; i < rings; ++i)
    for (int j = 0; j < 2 * rings; ++j) {
      const double radius = std::sqrt((i + 0.5) / rings), angle = kPi * (j + 0.5) / rings;
      act(radius * std::cos(angle), radius * std::sin(angle), 0.5 / rings / rings);
    }
}

TYPED_TEST(FacetsTest, DistributionOfVisibleNormals) {
  MALUS_TYPES;
  // Means over the facets are integrals over GGX: D(m) G1(o) (o.m)/(o.n) dm. Source of D: Walter et al. 2007.
  for (const double alpha : {0.1, 0.5, 1.0})
    for (const double degrees : {0.0, 30.0, 60.0, 85.0}) {
      const double theta = degrees * kPi / 180;
      const real3 n = O::make3(0, 0, 1), o = O::make3(R(std::sin(theta)), 0, R(std::cos(theta)));
      const auto visible = O::visibleFacets(o, n, R(alpha));
      double along = 0, across = 0, up = 0, weight = 0;
      overDisk(120, [&](double x, double y, double share) {
        const real3 m = O::facetNormal(visible, R(x), R(y));
        along += static_cast<double>(m.x) * share;
        across += std::abs(static_cast<double>(m.y)) * share;
        up += static_cast<double>(m.z) * share;
        weight += share;
      });
      double alongTruth = 0, acrossTruth = 0, upTruth = 0, sum = 0;
      constexpr int kSteps = 800;
      const double lambda = 0.5 * (std::sqrt(1 + std::pow(alpha * std::tan(theta), 2)) - 1);
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double t = kPi / 2 * (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps, z = std::cos(t);
          const double mx = std::sin(t) * std::cos(phi), my = std::sin(t) * std::sin(phi);
          const double d = alpha * alpha / (kPi * std::pow(z * z * (alpha * alpha - 1) + 1, 2));
          const double seen = std::max(mx * std::sin(theta) + z * std::cos(theta), 0.0);
          const double f =
              d / (1 + lambda) * seen / std::cos(theta) * std::sin(t) * (kPi / 2 / kSteps) * (2 * kPi / kSteps);
          sum += f, alongTruth += f * mx, acrossTruth += f * std::abs(my), upTruth += f * z;
        }
      SCOPED_TRACE(testing::Message() << "alpha " << alpha << ", " << degrees << " degrees");
      EXPECT_NEAR(weight, 1, 1e-9);
      EXPECT_NEAR(sum, 1, 2e-3);
      EXPECT_NEAR(along, alongTruth, 4e-3);
      EXPECT_NEAR(across, acrossTruth, 4e-3);
      EXPECT_NEAR(up, upTruth, 4e-3);
    }
}

TYPED_TEST(FacetsTest, MeanWeightIsTheAlbedo) {
  MALUS_TYPES;
  // The integral over directions of D G2/(4 o.n), the reflection without Fresnel; Walter et al. 2007.
  for (const double alpha : {0.1, 0.3, 0.7})
    for (const double degrees : {10.0, 56.31, 80.0}) {
      const double theta = degrees * kPi / 180;
      const real3 n = O::make3(0, 0, 1), o = O::make3(R(std::sin(theta)), 0, R(std::cos(theta)));
      const auto visible = O::visibleFacets(o, n, R(alpha));
      double mean = 0;
      overDisk(100, [&](double x, double y, double share) {
        const real3 m = O::facetNormal(visible, R(x), R(y));
        const real3 mirror = O::mirrorDirection(o * R(-1), m, O::dot3(o, m));
        mean += share * static_cast<double>(O::facetWeight(visible, mirror));
      });
      const auto lambda = [&](double z) { return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (z * z) - 1)) - 1); };
      double truth = 0;
      constexpr int kSteps = 600;
      for (int i = 0; i < kSteps; ++i)
        for (int j = 0; j < kSteps; ++j) {
          const double t = kPi / 2 * (i + 0.5) / kSteps, phi = 2 * kPi * (j + 0.5) / kSteps;
          const double x = std::sin(t) * std::cos(phi) + std::sin(theta), y = std::sin(t) * std::sin(phi),
                       z = std::cos(t) + std::cos(theta), mz = z / std::sqrt(x * x + y * y + z * z);
          const double d = alpha * alpha / (kPi * std::pow(mz * mz * (alpha * alpha - 1) + 1, 2));
          truth += d / (1 + lambda(std::cos(theta)) + lambda(std::cos(t))) / (4 * std::cos(theta)) * std::sin(t) *
                   (kPi / 2 / kSteps) * (2 * kPi / kSteps);
        }
      EXPECT_NEAR(mean, truth, 4e-3) << alpha << ' ' << degrees;
    }
}

TYPED_TEST(FacetsTest, EnergyIsNotCreated) {
  MALUS_TYPES;
  Draw draw(11);
  for (int i = 0; i < 3000; ++i) {
    const real3 n = toReal3<O>(draw.direction()), o = toReal3<O>(draw.direction());
    if (O::dot3(o, n) < 0) continue;
    const real alpha = R(draw.between(1e-4, 1)), radius = R(std::sqrt(draw.unit())), angle = R(draw.between(0, 6.28));
    const auto visible = O::visibleFacets(o, n, alpha);
    const real3 m = O::facetNormal(visible, radius * std::cos(angle), radius * std::sin(angle));
    EXPECT_CLOSE(O::dot3(m, m), 1, 8 * kEps);
    EXPECT_GT(O::dot3(m, n), 0);
    EXPECT_GE(O::dot3(m, o), -1e-5);  // visible from the camera
    const real3 i1 = O::mirrorDirection(o * R(-1), m, O::dot3(o, m));
    const real weight = O::facetWeight(visible, i1);
    EXPECT_GE(weight, 0);
    EXPECT_LE(weight, 1 + kEps);
    if (O::dot3(i1, n) <= 0) {
      EXPECT_EQ(weight, 0);
    }
  }
  // Nearly smooth: the surface's normal, and no masking.
  const real3 n = O::make3(0, 0, 1), o = O::normalize3(O::make3(1, 0, 1));
  const auto visible = O::visibleFacets(o, n, R(1e-5L));
  const real3 m = O::facetNormal(visible, R(0.5L), R(0.5L));
  EXPECT_CLOSE(m.z, 1, 1e-9 + kEps);
  EXPECT_CLOSE(O::facetWeight(visible, O::make3(-o.x, 0, o.z)), 1, 1e-9 + kEps);
}

TYPED_TEST(FacetsTest, RayleighSkyIsPolarizedAt90Degrees) {
  MALUS_TYPES;
  EXPECT_CLOSE(O::rayleighDegree(0, R(0.8L)), R(0.8L), kEps);
  EXPECT_EQ(O::rayleighDegree(1, R(0.8L)), 0);
  EXPECT_EQ(O::rayleighDegree(-1, R(0.8L)), 0);
  EXPECT_CLOSE(O::rayleighDegree(R(0.5L), 1), 0.6, kEps);  // sin^2/(1 + cos^2) at 60 degrees
  double mean = 0;
  constexpr int kSteps = 1000;
  for (int i = 0; i < kSteps; ++i)
    mean += static_cast<double>(O::rayleighPhase(R(-1 + (2.0L * i + 1) / kSteps))) / kSteps;
  EXPECT_NEAR(mean, 1, 1e-6);
}

}  // namespace
}  // namespace malus::test
