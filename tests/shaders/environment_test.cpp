// The octahedral map and the irradiance polynomial.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_OPTICS_SUITE(EnvironmentTest);

TYPED_TEST(EnvironmentTest, OctahedralMapRoundTrip) {
  MALUS_TYPES;
  Draw draw(11);
  Worst worst("octahedral", double(kEps));
  for (int i = 0; i < 5000; ++i) {
    const Vec d = draw.direction();
    real u, v;
    O::octahedralFromDirection(toReal3<O>(d), u, v);
    ASSERT_TRUE(u >= 0 && u <= 1 && v >= 0 && v <= 1);
    const Vec back = toVec(O::directionFromOctahedral(u, v));
    for (std::size_t j = 0; j < 3; ++j) worst.add(back[j] - d[j]);
  }
  // u is kept to half an eps of 1; the map stretches it by 2 and, at most, by sqrt(3) squared.
  EXPECT_LT(worst.value(), 8);
}

TYPED_TEST(EnvironmentTest, OctahedralAxesAndSeams) {
  MALUS_TYPES;
  real u, v;
  O::octahedralFromDirection(O::make3(0, 0, 1), u, v);
  EXPECT_CLOSE(u, R(0.5L), kExact) << "up is the middle";
  EXPECT_CLOSE(v, R(0.5L), kExact) << "up is the middle";
  O::octahedralFromDirection(O::make3(1, 0, 0), u, v);
  EXPECT_CLOSE(u, 1, kExact) << "+x is the right edge's middle";
  EXPECT_CLOSE(v, R(0.5L), kExact) << "+x is the right edge's middle";
  O::octahedralFromDirection(O::make3(0, -1, 0), u, v);
  EXPECT_CLOSE(u, R(0.5L), kExact) << "-y is v = 0";
  EXPECT_CLOSE(v, 0, kExact) << "-y is v = 0";
  O::octahedralFromDirection(O::make3(0, 0, -1), u, v);
  EXPECT_CLOSE(u, 1, kExact) << "down is the corners";
  EXPECT_CLOSE(v, 1, kExact) << "down is the corners";
  // All four corners are the direction down.
  for (const real a : {real(0), real(1)})
    for (const real b : {real(0), real(1)}) expectClose3(O::directionFromOctahedral(a, b), O::make3(0, 0, -1), kExact);
  // +0 and -0 of z map to the same seam.
  real u0, v0, u1, v1;
  O::octahedralFromDirection(O::make3(R(0.6L), R(0.8L), R(0.0L)), u0, v0);
  O::octahedralFromDirection(O::make3(R(0.6L), R(0.8L), R(-0.0L)), u1, v1);
  EXPECT_CLOSE(u0, u1, kExact);
  EXPECT_CLOSE(v0, v1, kExact);
}

TYPED_TEST(EnvironmentTest, OctahedralMapIsContinuousAcrossTheEquator) {
  MALUS_TYPES;
  // Across the fold the map continues: points a little above and below the equator are near each other.
  for (int degree = 1; degree < 360; degree += 7) {
    const Real a = degree * std::acos(Real(-1)) / 180, h = 1e-4L;
    real u0, v0, u1, v1;
    O::octahedralFromDirection(O::make3(R(std::cos(a)), R(std::sin(a)), R(h)), u0, v0);
    O::octahedralFromDirection(O::make3(R(std::cos(a)), R(std::sin(a)), R(-h)), u1, v1);
    EXPECT_CLOSE(u0, u1, 2 * h);
    EXPECT_CLOSE(v0, v1, 2 * h);
  }
}

// Clamped-cosine irradiance of radiance(direction), by quadrature; the polynomial's numbers by projection on
// the nine functions 1, y, z, x, xy, yz, 3z^2 - 1, xz, x^2 - y^2.
template <class F>
std::array<Real, 9> projected(const F& radiance) {
  const Real pi = std::acos(Real(-1));
  // Real spherical harmonics, squared norms: Y = k f; E = sum A_l Y L_lm, A = pi, 2 pi/3, pi/4.
  const Real norms[9] = {1 / (4 * pi),  3 / (4 * pi),  3 / (4 * pi),  3 / (4 * pi),  15 / (4 * pi),
                         15 / (4 * pi), 5 / (16 * pi), 15 / (4 * pi), 15 / (16 * pi)};
  const Real cosine[9] = {pi, 2 * pi / 3, 2 * pi / 3, 2 * pi / 3, pi / 4, pi / 4, pi / 4, pi / 4, pi / 4};
  std::array<Real, 9> c{};
  constexpr int kZ = 400, kPhi = 64;
  for (int i = 0; i < kZ; ++i)
    for (int j = 0; j < kPhi; ++j) {
      const Real z = -1 + (i + 0.5L) * 2 / kZ, phi = (j + 0.5L) * 2 * pi / kPhi, r = std::sqrt(1 - z * z);
      const Real x = r * std::cos(phi), y = r * std::sin(phi), weight = 4 * pi / (kZ * kPhi) * radiance(Vec{x, y, z});
      const Real f[9] = {1, y, z, x, x * y, y * z, 3 * z * z - 1, x * z, x * x - y * y};
      for (std::size_t m = 0; m < 9; ++m) c[m] += norms[m] * cosine[m] * f[m] * weight;
    }
  return c;
}

TYPED_TEST(EnvironmentTest, IrradianceOfConstantAndLinearSky) {
  MALUS_TYPES;
  Draw draw(12);
  const Real pi = std::acos(Real(-1));
  const Vec toward = oracle::unit({0.3L, -0.5L, 0.8L});
  // L = 1 + d . toward: irradiance pi + 2 pi/3 n . toward, exactly. L = (d . toward)^2: pi/3 + pi/4 ((n.t)^2 - 1/3).
  const auto linear = projected([&](const Vec& d) { return 1 + oracle::dot(d, toward); });
  const auto square = projected([&](const Vec& d) { return std::pow(oracle::dot(d, toward), 2); });
  for (int i = 0; i < 200; ++i) {
    const Vec n = draw.direction();
    const real3 normal = toReal3<O>(n);
    const auto irradiance = [&](const std::array<Real, 9>& c) {
      return O::irradiancePolynomial(normal, R(c[0]), R(c[1]), R(c[2]), R(c[3]), R(c[4]), R(c[5]), R(c[6]), R(c[7]),
                                     R(c[8]));
    };
    const Real p = oracle::dot(n, toward);
    EXPECT_CLOSE(irradiance(linear), pi + 2 * pi / 3 * p, 1e-4 + 10 * kEps);  // the quadrature's error
    EXPECT_CLOSE(irradiance(square), pi / 3 + pi / 4 * (p * p - 1 / Real(3)), 1e-4 + 10 * kEps);
  }
}

TYPED_TEST(EnvironmentTest, IrradianceIsNeverNegative) {
  MALUS_TYPES;
  EXPECT_EQ(O::irradiancePolynomial(O::make3(0, 0, -1), 0, 0, 5, 0, 0, 0, 0, 0, 0), 0);
}

}  // namespace
}  // namespace malus::test
