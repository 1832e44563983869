// Mueller matrices of rotation, reflection and transmission, alone and in chains, against Jones fields in space.
#include "tests/shaders/chains.h"

namespace malus::test {
namespace {

using oracle::Complex;
using oracle::Real;
using oracle::Stokes4;
using oracle::Vec;

MALUS_OPTICS_SUITE(StokesTest);

template <class O>
typename O::Stokes toStokes(const Stokes4& s) {
  using real = typename O::real;
  return {O::splat3(static_cast<real>(s[0])), O::splat3(static_cast<real>(s[1])), O::splat3(static_cast<real>(s[2])),
          O::splat3(static_cast<real>(s[3]))};
}
template <class S>
Stokes4 toStokes4(const S& s, int colour) {
  return {s.s0[colour], s.s1[colour], s.s2[colour], s.s3[colour]};
}
Stokes4 randomStokes(Draw& draw, Real degree) {
  const Vec p = draw.direction();
  return {1, degree * p[0], degree * p[1], degree * p[2]};
}

// Light of the ray with direction d, between its canonical frame and the frame of a surface with s direction
// `across`.
template <class O, class S, class V>
S rotateStokes(const S& s, const V& d, const V& across, bool toSurface) {
  using real = typename O::real;
  V x, y;
  real cos2, sin2;
  O::canonicalFrame(d * real(-1), x, y);
  O::frameRotation(across, x, y, cos2, sin2);
  return O::rotateStokes(s, cos2, toSurface ? sin2 : -sin2);
}
// Light along a path, back to the camera, in the canonical frame of its first ray.
template <class O>
typename O::Stokes along(const Path& path, typename O::Stokes s) {
  using real = typename O::real;
  const auto one = O::splat3(1), zero = O::splat3(0);
  for (std::size_t i = path.bounces.size(); i-- > 0;) {
    const Bounce& b = path.bounces[i];
    const auto n = toReal3<O>(b.n), d = toReal3<O>(path.d[i]);
    const real c = O::clampUnit(-O::dot3(d, n)), n1 = static_cast<real>(b.n1);
    const auto across = O::sDirection(d, n);
    s = rotateStokes<O>(s, toReal3<O>(path.d[i + 1]), across, true);
    if (b.transmits) {
      const auto t = O::dielectricTransmittance(c, n1, static_cast<real>(b.n2[0].real()));
      s = O::stokesInterface(s, one * t.ts, one * t.tp, one * t.x, zero);
    } else {
      auto rs = zero, rp = zero, xRe = zero, xIm = zero;
      for (int j = 0; j < 3; ++j) {
        const auto index = b.n2[static_cast<std::size_t>(j)];
        const real n2 = static_cast<real>(index.real()), k2 = static_cast<real>(-index.imag());
        const auto r = b.metal ? O::conductorReflectance(c, n1, n2, k2) : O::dielectricReflectance(c, n1, n2);
        rs[j] = r.rs;
        rp[j] = r.rp;
        xRe[j] = r.xRe;
        xIm[j] = r.xIm;
      }
      s = O::stokesInterface(s, rs, rp, xRe, xIm);
    }
    s = rotateStokes<O>(s, d, across, false);
  }
  return s;
}

TYPED_TEST(StokesTest, RotationIdentities) {
  MALUS_TYPES;
  Draw draw(20);
  const auto turn = [&](const typename O::Stokes& s, Real angle) {
    return O::rotateStokes(s, R(std::cos(2 * angle)), R(std::sin(2 * angle)));
  };
  for (int i = 0; i < 500; ++i) {
    const auto s = toStokes<O>(randomStokes(draw, draw.unit()));
    const Real a = draw.between(-4, 4), b = draw.between(-4, 4);
    const Stokes4 twice = toStokes4(turn(turn(s, a), b), 0), once = toStokes4(turn(s, a + b), 0);
    const Stokes4 back = toStokes4(turn(turn(s, a), -a), 1), start = toStokes4(s, 1);
    const Stokes4 half = toStokes4(turn(s, std::acos(Real(-1))), 2);
    for (std::size_t j = 0; j < 4; ++j) {
      EXPECT_CLOSE(twice[j], once[j], 4 * kEps);
      EXPECT_CLOSE(back[j], start[j], 3 * kEps);
      EXPECT_CLOSE(half[j], start[j], kEps) << "half a turn is none";
    }
  }
  // A frame rotated by +45 degrees has its x along the +45 degrees of the old one.
  const Stokes4 s = toStokes4(O::rotateStokes(toStokes<O>({1, 0, 1, 0}), 0, 1), 0);
  EXPECT_TRUE(s[1] == 1 && s[2] == 0);
}

TYPED_TEST(StokesTest, InterfaceIsTheMuellerMatrixOfItsAmplitudes) {
  MALUS_TYPES;
  Draw draw(21);
  Worst worst("mueller", double(kEps));
  for (int i = 0; i < 3000; ++i) {
    const real c = R(draw.between(0.05, 1));
    const Metal& metal = kMetals[draw.below(5)];
    const real n = R(metal.n[0]), k = R(metal.k[0]);
    const oracle::Amplitudes a = oracle::amplitudes(c, 1, Complex(n, -k));
    oracle::Jones j;
    j.m[0][0] = a.rs;
    j.m[1][1] = a.rp;
    const auto m = oracle::muellerMatrix(j);
    const Stokes4 in = randomStokes(draw, draw.unit());
    const auto r = O::conductorReflectance(c, 1, n, k);
    const Stokes4 out = toStokes4(
        O::stokesInterface(toStokes<O>(in), O::splat3(r.rs), O::splat3(r.rp), O::splat3(r.xRe), O::splat3(r.xIm)), 1);
    for (std::size_t row = 0; row < 4; ++row) {
      Real want = 0;
      for (std::size_t column = 0; column < 4; ++column) want += m[row][column] * in[column];
      worst.add(out[row] - want);
    }
  }
  EXPECT_LT(worst.value(), 12);  // that of the conductor, doubled by the second column
}

TYPED_TEST(StokesTest, ReflectionKeepsLightPhysical) {
  MALUS_TYPES;
  Draw draw(22);
  Worst worst("physical", double(kEps));
  for (int i = 0; i < 20000; ++i) {
    const Stokes4 in = randomStokes(draw, 1 - 2 * kEps);  // unit length but for its own rounding
    const real c = i % 10 == 0 ? R(std::pow(10.0L, -draw.between(0, 8))) : R(draw.unit());
    const Metal& metal = kMetals[draw.below(5)];
    const auto r = draw.below(2) == 0   ? O::conductorReflectance(c, 1, R(metal.n[1]), R(metal.k[1]))
                   : draw.below(2) == 0 ? O::dielectricReflectance(c, 1, R(1.5L))
                                        : O::dielectricReflectance(c, R(1.5L), 1);
    const Stokes4 out = toStokes4(
        O::stokesInterface(toStokes<O>(in), O::splat3(r.rs), O::splat3(r.rp), O::splat3(r.xRe), O::splat3(r.xIm)), 0);
    const Real length = std::sqrt(out[1] * out[1] + out[2] * out[2] + out[3] * out[3]);
    worst.add(std::max(Real(0), length - out[0]) / ((r.rs + r.rp) / 2));
    EXPECT_LE(out[0], 1 + 4 * kEps);
  }
  EXPECT_LE(worst.value(), 4);  // |S| - S0 <= 4 eps A S0
}

TYPED_TEST(StokesTest, CrossedBrewsterMirrorsExtinguish) {
  MALUS_TYPES;
  // The second plane of incidence is at 90 degrees to the first: what one reflects the other extinguishes.
  const Real c = 1 / std::sqrt(1 + 2.25L);
  Path path;
  path.d.push_back({0, 0, 1});
  extend(path, glassMirror(), oracle::unit({std::sqrt(1 - c * c), 0, -c}));
  const Vec d = path.d.back(), across{0, 1, 0};
  extend(path, glassMirror(), oracle::along(d, -c, across, std::sqrt(1 - c * c)));
  const auto s = along<O>(path, O::stokesUnpolarized(O::splat3(1)));
  EXPECT_CLOSE(s.s0.x, 0, kEps);
  // Uncrossed they send back R_s^2 / 2.
  Path same;
  same.d.push_back({0, 0, 1});
  extend(same, glassMirror(), oracle::unit({std::sqrt(1 - c * c), 0, -c}));
  const Vec e = same.d.back(), inPlane = oracle::cross(Vec{0, 1, 0}, e);
  extend(same, glassMirror(), oracle::along(e, -c, inPlane, std::sqrt(1 - c * c)));
  const Real rs = std::pow(1.25L / 3.25L, 2);
  EXPECT_CLOSE(along<O>(same, O::stokesUnpolarized(O::splat3(1))).s0.x, rs * rs / 2, 4 * kEps);
}

TYPED_TEST(StokesTest, GoldPeriscopePerColour) {
  MALUS_TYPES;
  // Two mirrors at 45 degrees; the second rotated by f about the ray between: A^2 (1 + D^2 cos 2f).
  const Real half = std::sqrt(0.5L);
  for (int degree = 0; degree <= 180; degree += 15) {
    const Real f = degree * std::acos(Real(-1)) / 180;
    Path path;
    path.d.push_back({1, 0, 0});
    extend(path, metalMirror(kMetals[0]), {-half, 0, half});
    ASSERT_NEAR(double(path.d.back()[2]), 1, 1e-15);
    extend(path, metalMirror(kMetals[0]), {half * std::cos(f), half * std::sin(f), -half});
    const auto s = along<O>(path, O::stokesUnpolarized(O::splat3(1)));
    for (int colour = 0; colour < 3; ++colour) {
      const oracle::Powers p = oracle::powers(half, 1, path.bounces[0].n2[static_cast<std::size_t>(colour)]);
      const Real a = (p.rs + p.rp) / 2, d = (p.rs - p.rp) / (p.rs + p.rp);
      EXPECT_CLOSE(s.s0[colour], a * a * (1 + d * d * std::cos(2 * f)), 8 * kEps) << degree << ' ' << colour;
    }
  }
}

TYPED_TEST(StokesTest, FresnelRhombMakesCircularLight) {
  MALUS_TYPES;
  // tan(delta/2) = cos sqrt(sin^2 - 1/n^2)/sin^2 = tan(22.5 degrees) at each of two total reflections.
  Real low = std::asin(1 / 1.5L) + 0.15L, high = low + 0.3L;  // the larger of the two angles
  const auto excess = [](Real a) {
    const Real s2 = std::sin(a) * std::sin(a);
    return std::cos(a) * std::sqrt(s2 - 1 / 2.25L) / s2 - (std::sqrt(2.0L) - 1);
  };
  ASSERT_GT(excess(low), 0);
  ASSERT_LT(excess(high), 0);
  for (int i = 0; i < 80; ++i) (excess((low + high) / 2) > 0 ? low : high) = (low + high) / 2;
  const auto r = O::dielectricReflectance(R(std::cos(low)), R(1.5L), 1);
  auto s = toStokes<O>({1, 0, 1, 0});
  for (int i = 0; i < 2; ++i)
    s = O::stokesInterface(s, O::splat3(r.rs), O::splat3(r.rp), O::splat3(r.xRe), O::splat3(r.xIm));
  EXPECT_EQ(s.s0.x, 1);
  EXPECT_CLOSE(s.s1.x, 0, kEps);
  EXPECT_CLOSE(s.s2.x, 0, 8 * kEps);  // the phase of two reflections moves by 2 roundings of the angle each
  EXPECT_CLOSE(s.s3.x, 1, 4 * kEps);  // right circular, as by the oracle:
  const oracle::Powers p = oracle::powers(std::cos(low), 1.5L, 1);
  EXPECT_CLOSE((p.x * p.x).imag(), 1, 1e-15);
}

TYPED_TEST(StokesTest, LoopOfMirrorsIsAProductOfHalfTurns) {
  MALUS_TYPES;
  // A ray z -> x -> y -> z on perfect mirrors: each maps the field by 2 n n^T - 1, n along d_out - d_in.
  const Vec axes[4] = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  Draw draw(23);
  for (int trial = 0; trial < 50; ++trial) {
    const Complex ex(draw.between(-1, 1), draw.between(-1, 1)), ey(draw.between(-1, 1), draw.between(-1, 1));
    oracle::Field e = oracle::sum({1, 0, 0}, ex, {0, 1, 0}, ey);
    const Real size = oracle::stokesFromField(ex, ey)[0];
    auto s = toStokes<O>(oracle::stokesFromField(ex, ey));  // canonical frame of z: x, y
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec n = oracle::unit(oracle::along(axes[i + 1], 1, axes[i], -1));
      const Complex en = oracle::dot(e, n);
      for (std::size_t j = 0; j < 3; ++j) e[j] = Real(2) * n[j] * en - e[j];
      // The light travels along the axis, opposite to a camera ray.
      const auto rayIn = toReal3<O>(axes[i]) * real(-1), rayOut = toReal3<O>(axes[i + 1]) * real(-1);
      const auto across = O::sDirection(rayIn, toReal3<O>(n));
      s = rotateStokes<O>(s, rayIn, across, true);
      s = O::stokesInterface(s, O::splat3(1), O::splat3(1), O::splat3(-1), O::splat3(0));
      s = rotateStokes<O>(s, rayOut, across, false);
    }
    const Stokes4 want = oracle::stokesFromField(e[0], e[1]), got = toStokes4(s, 0);
    EXPECT_LT(std::abs(e[2]), 1e-15L);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_CLOSE(got[j], want[j], 8 * kEps * size);
  }
}

TYPED_TEST(StokesTest, SlabTransmittanceSeries) {
  MALUS_TYPES;
  for (int i = 1; i <= 100; ++i) {
    const real c = static_cast<real>(i) / 100;
    const Real cosT = std::sqrt(1 - (1 - Real(c) * c) / 2.25L);
    const auto in = O::dielectricTransmittance(c, 1, R(1.5L)), out = O::dielectricTransmittance(R(cosT), R(1.5L), 1);
    const auto inner = O::dielectricReflectance(R(cosT), R(1.5L), 1);
    const oracle::Powers p = oracle::powers(c, 1, 1.5L);
    Real s = 0, t = 0, s1 = 1, t1 = 1;
    for (int k = 0; k < 3000; ++k) {
      s += in.ts * s1 * out.ts;
      t += in.tp * t1 * out.tp;
      s1 *= Real(inner.rs) * inner.rs;
      t1 *= Real(inner.rp) * inner.rp;
    }
    // Near grazing the inner cosine's rounding is magnified by the ratio of the two.
    const Real allowed = 8 * kEps / c;
    EXPECT_CLOSE(s, (1 - p.rs) / (1 + p.rs), allowed) << c;
    EXPECT_CLOSE(t, (1 - p.rp) / (1 + p.rp), allowed) << c;
  }
}

TYPED_TEST(StokesTest, RandomChainsEqualJones) {
  MALUS_TYPES;
  Draw draw(24);
  Worst worst("chain", double(kEps));
  for (int i = 0; i < 2000; ++i) {
    const Path path = randomPath(draw, 1 + draw.below(6));
    const auto s = along<O>(path, O::stokesUnpolarized(O::splat3(1)));
    for (int colour = 0; colour < 3; ++colour) {
      const auto index = static_cast<std::size_t>(colour);
      const Stokes4 want = expectedStokes(path, index), got = toStokes4(s, colour);
      for (std::size_t j = 0; j < 4; ++j) worst.add((got[j] - want[j]) / unpolarizedShare(path, index));
    }
  }
  // Up to six interfaces, each with a dozen roundings and two rotations, whose cosines steep angles magnify.
  EXPECT_LT(worst.value(), 60);
}

TYPED_TEST(StokesTest, CircularLightMattersBetweenTwoPhaseShifters) {
  MALUS_TYPES;
  // Glass, gold, gold, glass, each plane twisted by 45 degrees: the smallest chain where S3 matters.
  Draw draw(25);
  Path path;
  path.d.push_back(oracle::unit({0.2L, -0.1L, 1}));
  const Vec start = oracle::anyAcross(path.d[0]);
  Vec plane = start;
  const Bounce kinds[4] = {glassMirror(), metalMirror(kMetals[0]), metalMirror(kMetals[0]), glassMirror()};
  for (const Bounce& kind : kinds) {
    const Vec d = path.d.back();
    const Vec flat = oracle::unit(oracle::along(plane, 1, d, -oracle::dot(plane, d)));
    const Vec twisted = oracle::along(flat, std::sqrt(0.5L), oracle::cross(d, flat), std::sqrt(0.5L));
    extend(path, kind, oracle::unit(oracle::along(d, -0.5L, twisted, std::sqrt(0.75L))));
    plane = twisted;
  }
  const auto s = along<O>(path, O::stokesUnpolarized(O::splat3(1)));
  for (int colour = 0; colour < 3; ++colour) {
    const auto index = static_cast<std::size_t>(colour);
    const Stokes4 want = expectedStokes(path, index), got = toStokes4(s, colour);
    for (std::size_t j = 0; j < 4; ++j) EXPECT_CLOSE(got[j], want[j], 60 * kEps * unpolarizedShare(path, index));
  }
}

}  // namespace
}  // namespace malus::test
