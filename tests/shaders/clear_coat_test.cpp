// The coat of clear_coat.h against the sum of its paths, each a product of Jones matrices in long double, and against
// its limits.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Real;
using Cx = oracle::Complex;
using Matrix = std::array<oracle::Stokes4, 4>;

struct Sum {
  Matrix reflected{}, transmitted{};
};

// Amplitudes of a path along s and p, in place of its diagonal Jones matrix.
struct Path {
  Cx s = 1, p = 1;
};
Path after(const Path& path, Cx s, Cx p) { return {path.s * s, path.p * p}; }
void add(Matrix& sum, const Path& path, Real flux) {
  oracle::Jones jones;
  jones.m[0][0] = path.s;
  jones.m[1][1] = path.p;
  const Matrix m = oracle::muellerMatrix(jones);
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) sum[i][j] += flux * m[i][j];
}

// Sum of the Mueller matrices of all paths: those that leave into n1 after k reflections at n2, and those into n2.
Sum addPaths(Real c, Real n1, Real coat, Cx n2) {
  const oracle::Amplitudes enter = oracle::amplitudes(c, n1, coat);
  const Real inside = enter.cosT.real();
  const oracle::Amplitudes leave = oracle::amplitudes(inside, coat, n1), base = oracle::amplitudes(inside, coat, n2);
  const Real flux = (n2 * base.cosT).real() / (n1 * c);
  Sum sum;
  add(sum.reflected, {enter.rs, enter.rp}, 1);
  Path down{enter.ts, enter.tp};
  for (int k = 0; k < 20000 && std::norm(down.s) + std::norm(down.p) > 1e-30L; ++k) {
    if (n2.imag() == 0) add(sum.transmitted, after(down, base.ts, base.tp), flux);
    const Path up = after(down, base.rs, base.rp);
    add(sum.reflected, after(up, leave.ts, leave.tp), 1);
    down = after(up, leave.rs, leave.rp);
  }
  return sum;
}

template <class Terms>
void compare(Worst& worst, const Terms& got, const Matrix& want) {
  const Real a = (Real(got.rs) + Real(got.rp)) / 2, b = (Real(got.rs) - Real(got.rp)) / 2;
  worst.add(a - want[0][0]);
  worst.add(a - want[1][1]);
  worst.add(b - want[0][1]);
  worst.add(b - want[1][0]);
  worst.add(got.xRe - want[2][2]);
  worst.add(got.xRe - want[3][3]);
  worst.add(got.xIm - want[3][2]);
  worst.add(-got.xIm - want[2][3]);
}

// Whether a rounding of the cosine can move R: near a critical angle.
bool isCritical(Real c, Real n1, Real n2) { return std::abs(n2 * n2 / (n1 * n1) - (1 - c) * (1 + c)) < 0.02L; }

MALUS_OPTICS_SUITE(ClearCoatTest);

TYPED_TEST(ClearCoatTest, EqualsTheSumOfItsPathsOnMetal) {
  MALUS_TYPES;
  Draw draw(81);
  Worst worst("worst", double(kEps));
  for (int i = 0; i < 400; ++i) {
    const Metal& metal = kMetals[draw.below(5)];
    const std::size_t colour = draw.below(3);
    const real c = R(draw.below(2) == 0 ? std::pow(10.0, draw.between(-6, 0)) : draw.between(0.02, 1)),
               n1 = R(draw.below(2) == 0 ? 1.0 : 1.33), coat = R(draw.between(1.4, 1.8)), n2 = R(metal.n[colour]),
               k2 = R(metal.k[colour]);
    compare(worst, O::coatOnConductor(c, n1, coat, n2, k2, 1).reflected, addPaths(c, n1, coat, Cx(n2, -k2)).reflected);
  }
  EXPECT_LT(worst.value(), 40);
}

TYPED_TEST(ClearCoatTest, EqualsTheSumOfItsPathsOnGlassFromBothSides) {
  MALUS_TYPES;
  Draw draw(82);
  Worst reflected("reflected", double(kEps)), transmitted("transmitted", double(kEps));
  int totals = 0;
  for (int i = 0; i < 800; ++i) {
    const real glass = R(draw.between(1.05, 2.4)), coat = R(1.5), c = R(draw.between(0.02, 1));
    const bool isEntering = draw.below(2) == 0;
    const real n1 = isEntering ? R(1.0) : glass, n2 = isEntering ? glass : R(1.0);
    if (isCritical(c, n1, coat) || isCritical(c, n1, n2)) continue;
    if ((1 - Real(c)) * (1 + Real(c)) * Real(n1) * Real(n1) >= Real(coat) * Real(coat)) continue;
    const auto got = O::coatOnDielectric(c, n1, coat, n2, 1, 1);
    const Sum want = addPaths(c, n1, coat, Cx(n2, 0));
    compare(reflected, got.reflected, want.reflected);
    compare(transmitted, got.transmitted, want.transmitted);
    totals += got.transmitted.rs == 0 ? 1 : 0;
  }
  EXPECT_LT(reflected.value(), 100);
  EXPECT_LT(transmitted.value(), 100);
  EXPECT_GT(totals, 50) << "total reflection at the outer interface";
}

TYPED_TEST(ClearCoatTest, EqualIndicesAreOneInterface) {
  MALUS_TYPES;
  Draw draw(83);
  for (int i = 0; i < 2000; ++i) {
    const real c = R(draw.below(4) == 0 ? std::pow(10.0, draw.between(-8, -1)) : draw.unit()), n = R(1.5);
    // A coat of the base's index, and one of the outer medium's.
    for (const auto& got : {O::coatOnDielectric(c, 1, n, n, 1, 1), O::coatOnDielectric(c, 1, 1, n, 1, 1)}) {
      const auto one = O::dielectricReflectance(c, 1, n);
      EXPECT_CLOSE(got.reflected.rs, one.rs, 8 * kEps);
      EXPECT_CLOSE(got.reflected.rp, one.rp, 8 * kEps);
      EXPECT_CLOSE(got.reflected.xRe, one.xRe, 8 * kEps);
      EXPECT_CLOSE(got.transmitted.xRe, O::dielectricTransmittance(c, 1, n).x, 16 * kEps);
    }
  }
}

// Shares cover the interfaces in the order in which the light meets them.
TYPED_TEST(ClearCoatTest, SharesOfInterfaces) {
  MALUS_TYPES;
  for (const real c : {R(0.9), R(0.3)}) {
    const auto coat = O::dielectricReflectance(c, 1, R(1.5));
    const auto bare = O::coatOnDielectric(c, 1, R(1.5), R(1.9), 1, 0);
    EXPECT_CLOSE(bare.reflected.rs, coat.rs, 4 * kEps);
    EXPECT_CLOSE(bare.reflected.rp, coat.rp, 4 * kEps);
    EXPECT_CLOSE(bare.transmitted.rs, 1 - coat.rs, 4 * kEps);
    const auto none = O::coatOnDielectric(c, 1, R(1.5), R(1.9), 0, 0);
    EXPECT_EQ(none.reflected.rs, 0);
    EXPECT_CLOSE(none.transmitted.rp, 1, kExact);
    const auto black = O::coatOnConductor(c, 1, R(1.5), R(0.2), R(3.4), 0);
    EXPECT_CLOSE(black.reflected.rp, coat.rp, 4 * kEps);
  }
}

// A share of the first interface: the series of Mueller matrices, whose block of S2 and S3 is a complex number.
TYPED_TEST(ClearCoatTest, AShareOfTheFirstInterfaceIsASumOfMatrices) {
  MALUS_TYPES;
  Draw draw(85);
  Worst worst("worst", double(kEps));
  for (int i = 0; i < 400; ++i) {
    const real c = R(draw.between(0.3, 1)), share = R(draw.between(0.05, 0.95)), glass = R(draw.between(1.6, 2.2));
    if (isCritical(c, glass, 1) || isCritical(c, glass, R(1.5))) continue;
    const real inside = std::sqrt(1 - (glass / R(1.5)) * (glass / R(1.5)) * (1 - c * c));
    if (!(inside > 0)) continue;  // total at the first interface
    const auto first = O::dielectricReflectance(c, glass, R(1.5));
    const auto second = O::dielectricReflectance(inside, R(1.5), 1);
    const Real open = 1 - Real(share),
               through = Real(share) * std::sqrt((1 - Real(first.rs)) * (1 - Real(first.rp))) + open;
    const Cx x1 = Real(share) * Cx(first.xRe, first.xIm), x2(second.xRe, second.xIm);
    Cx sum = x1, term = through * through * x2;
    for (int k = 0; k < 2000; ++k, term *= x1 * x2) sum += term;
    const auto got = O::coatOnDielectric(c, glass, R(1.5), 1, share, 1);
    worst.add(Real(got.reflected.xRe) - sum.real());
    worst.add(Real(got.reflected.xIm) - sum.imag());
  }
  EXPECT_LT(worst.value(), 100);
}

TYPED_TEST(ClearCoatTest, ConservesEnergyDownToGrazingIncidence) {
  MALUS_TYPES;
  Draw draw(84);
  for (int i = 0; i < 20000; ++i) {
    const real c = R(draw.below(8) == 0 ? 0 : std::pow(10.0, draw.between(-20, 0))), coat = R(draw.between(1, 2.5)),
               n2 = R(draw.below(4) == 0 ? 1.0 : draw.between(0.5, 3)), share = R(draw.unit());
    const auto glass = O::coatOnDielectric(c, 1, coat, n2, 1, share);
    ASSERT_NEAR(double(glass.reflected.rs + glass.transmitted.rs), 1, double(16 * kEps));
    ASSERT_NEAR(double(glass.reflected.rp + glass.transmitted.rp), 1, double(16 * kEps));
    const auto metal = O::coatOnConductor(c, 1, coat, n2, R(draw.between(0, 4)), share);
    for (const auto& m : {glass.reflected, glass.transmitted, metal.reflected}) {
      ASSERT_GE(m.rs, 0);
      ASSERT_LE(m.rs, 1);
      ASSERT_LE(m.rp, 1);
      ASSERT_LE(m.xRe * m.xRe + m.xIm * m.xIm, m.rs * m.rp * (1 + 32 * kEps) + 4 * kEps * kEps);
    }
  }
}

}  // namespace
}  // namespace malus::test
