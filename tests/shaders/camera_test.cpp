// The pinhole camera: directions, the frame of its rays, analysers.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using oracle::Vec;

MALUS_OPTICS_SUITE(CameraTest);

TYPED_TEST(CameraTest, CentreAndCorners) {
  MALUS_TYPES;
  const real3 right = O::make3(1, 0, 0), up = O::make3(0, 0, 1), forward = O::make3(0, 1, 0);
  const auto at = [&](double x, double y) {
    return O::cameraDirection(right, up, forward, R(0.5L), R(0.25L), R(x), R(y));
  };
  expectClose3(at(0.5, 0.5), forward, kExact);
  const real3 corner = at(0, 0);
  EXPECT_CLOSE(corner.x / corner.y, -0.5L, 2 * kEps);  // left
  EXPECT_CLOSE(corner.z / corner.y, 0.25L, 2 * kEps);  // up
  const real3 low = at(1, 1);
  EXPECT_CLOSE(low.x / low.y, 0.5L, 2 * kEps);
  EXPECT_CLOSE(low.z / low.y, -0.25L, 2 * kEps);
}

// The directions of samples are those of long double axes to the rounding of their normalization, however the axes are
// rounded.
TYPED_TEST(CameraTest, SampleDirectionsKeepTheAxes) {
  MALUS_TYPES;
  Draw draw(17);
  Worst worst("sample", double(kEps));
  for (int i = 0; i < 200; ++i) {
    const Vec forward = draw.direction(), right = oracle::unit(oracle::cross(forward, draw.direction()));
    const Real columns = 1 + static_cast<Real>(draw.below(8192)), tan = draw.between(0.01, 2);
    const auto coarse = [](const Vec& v) {
      const Real unit = 0x1p-20L;
      return Vec{std::round(v[0] / unit) * unit, std::round(v[1] / unit) * unit, std::round(v[2] / unit) * unit};
    };
    const Vec first = oracle::along(forward, 1, right, -tan), step = oracle::along(right, 2 * tan / columns, right, 0);
    const Vec firstCoarse = coarse(first), stepCoarse = coarse(step);
    const real3 none = O::splat3(0);
    for (int sample = 0; sample < 20; ++sample) {
      const Real column = std::floor(columns * static_cast<Real>(draw.unit()));
      const real3 got = O::cameraSampleDirection(
          toReal3<O>(firstCoarse), toReal3<O>(oracle::along(first, 1, firstCoarse, -1)), toReal3<O>(stepCoarse),
          toReal3<O>(oracle::along(step, 1, stepCoarse, -1)), none, none, R(column), 0);
      const Vec want = oracle::unit(oracle::along(first, 1, step, column));
      for (std::size_t j = 0; j < 3; ++j) {
        const Vec across = oracle::cross(want, toVec(got));  // a common factor keeps the direction
        worst.add(across[j]);
      }
    }
  }
  EXPECT_LT(worst.value(), 1.5);
}

TYPED_TEST(CameraTest, XOfTheFrameIsPerpendicularToUp) {
  MALUS_TYPES;
  Draw draw(16);
  Worst worst("camera", double(kEps));
  for (int i = 0; i < 2000; ++i) {
    const Vec d = draw.direction(), up{0, 0, 1};
    if (std::abs(d[2]) > 0.99L) continue;  // x is undefined along up
    real cos2, sin2;
    O::cameraFrameRotation(toReal3<O>(d), toReal3<O>(up), cos2, sin2);
    // The rotation must take light in the canonical frame of -d to light in the frame with x = d x up.
    const Vec k = oracle::along(d, -1, d, 0), x = oracle::unit(oracle::cross(d, up));
    const oracle::Beam beam = oracle::polarized(k, oracle::anyAcross(k), {0.6L, 0.3L}, {-0.2L, 0.5L});
    const oracle::Stokes4 s = oracle::measured(beam, oracle::canonicalX(k)), want = oracle::measured(beam, x);
    typename O::Stokes in;
    in.s0 = O::splat3(R(s[0]));
    in.s1 = O::splat3(R(s[1]));
    in.s2 = O::splat3(R(s[2]));
    in.s3 = O::splat3(R(s[3]));
    const auto out = O::rotateStokes(in, cos2, sin2);
    const real got[4] = {out.s0.x, out.s1.y, out.s2.z, out.s3.x};
    for (std::size_t j = 0; j < 4; ++j) worst.add((got[j] - want[j]) * std::sqrt(1 - d[2] * d[2]));
  }
  EXPECT_LT(worst.value(), 3);  // times 1/sin of the angle to up
}

TYPED_TEST(CameraTest, AnalyserIsAMuellerRow) {
  MALUS_TYPES;
  typename O::Stokes s;
  s.s0 = O::make3(1, 2, 3);
  s.s1 = O::make3(R(0.5L), 0, 0);
  s.s2 = O::make3(0, 1, 0);
  s.s3 = O::make3(0, 0, 2);
  const real3 out = O::analysed(s, R(0.5L), R(0.25L), R(-0.5L), 1);
  EXPECT_EQ(out, O::make3(R(0.625L), R(0.5L), R(3.5L)));
}

}  // namespace
}  // namespace malus::test
