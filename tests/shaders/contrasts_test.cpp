// Contrasts of nearly equal indices that double precision knows and the rounded indices do not: the reflectance has the
// accuracy of the contrast, for dielectrics, conductors, panes and films. Closed forms in long double, from the
// contrast and not from a difference.
#include "tests/shaders/optics_types.h"

namespace malus::test {
namespace {

using oracle::Complex;
using oracle::Real;

MALUS_OPTICS_SUITE(ContrastTest);

constexpr Real kPi = 3.14159265358979323846L;
constexpr double kOuter[] = {1.0, 1.33, 1.5, 2.42};
constexpr double kContrasts[] = {1e-3, 1e-5, 1e-6, 2e-7, 1e-8, 1e-12, -1e-3, -1e-5, -1e-6, -2e-7, -1e-8, -1e-12};
constexpr double kCosines[] = {1.0, 0.9, 0.5, 0.1, 0.0174524064372835};

struct Amplitudes {
  Complex rs, rp;
};
// r_s = -(eta^2 - 1)/(c + t)^2, r_p = r_s (sin^2 - c t)/(sin^2 + c t), where eta = (n1 + contrast - i k)/n1.
Amplitudes fromContrast(Real c, Real n1, Real contrast, Real k) {
  const Real n2 = n1 + contrast, sinSq = (1 - c) * (1 + c);
  const Complex e = Complex(contrast * (2 * n1 + contrast) - k * k, -2 * n2 * k) / (n1 * n1);
  Complex t = std::sqrt(e + c * c);
  if (t.imag() > 0 || (t.imag() == 0 && t.real() < 0)) t = -t;
  const Complex rs = -e / ((c + t) * (c + t));
  return {rs, rs * (sinSq - c * t) / (sinSq + c * t)};
}

// Numbers as a renderer has them: rounded indices, and the rounded contrast.
template <class O>
struct Rounded {
  using real = typename O::real;
  real c, n1, n2, contrast;
  Real exactC, exactN1, exactContrast;  // values of the rounded numbers
  Rounded(double cosine, double outer, double difference)
      : c(static_cast<real>(cosine)),
        n1(static_cast<real>(outer)),
        n2(static_cast<real>(outer + difference)),
        contrast(static_cast<real>(difference)),
        exactC(c),
        exactN1(n1),
        exactContrast(contrast) {}
};

template <class O, class Compare>
void forEachContrast(const Compare& compare) {
  for (const double n1 : kOuter)
    for (const double contrast : kContrasts)
      for (const double c : kCosines) compare(Rounded<O>(c, n1, contrast));
}

TYPED_TEST(ContrastTest, Dielectric) {
  MALUS_TYPES;
  Worst worst("dielectric", double(kEps));
  forEachContrast<TypeParam>([&](const auto& in) {
    const auto terms = O::refractionTermsWith(in.c, in.n1, in.n2, in.contrast);
    EXPECT_FALSE(terms.matched);
    const auto got = O::reflectanceFromTerms(in.c, terms);
    const Amplitudes want = fromContrast(in.exactC, in.exactN1, in.exactContrast, 0);
    worst.add((got.rs - std::norm(want.rs)) / std::norm(want.rs));
    // r_p vanishes at Brewster's angle.
    worst.add((got.rp - std::norm(want.rp)) / std::norm(want.rs));
    worst.add((got.xRe - (want.rp * std::conj(want.rs)).real()) / std::norm(want.rs));
  });
  EXPECT_LT(worst.value(), 20);
}

TYPED_TEST(ContrastTest, Conductor) {
  MALUS_TYPES;
  Worst worst("conductor", double(kEps));
  for (const double k : {0.0, 1e-9, 1e-7, 1e-6, 1e-3})
    forEachContrast<TypeParam>([&](const auto& in) {
      const auto got = O::conductorReflectanceWith(in.c, in.n1, in.n2, R(k), in.contrast);
      const Amplitudes want = fromContrast(in.exactC, in.exactN1, in.exactContrast, R(k));
      worst.add((got.rs - std::norm(want.rs)) / std::norm(want.rs));
      worst.add((got.rp - std::norm(want.rp)) / std::norm(want.rs));
    });
  EXPECT_LT(worst.value(), 40);
}

TYPED_TEST(ContrastTest, SchlickAtNormalIncidence) {
  MALUS_TYPES;
  Worst worst("schlick", double(kEps));
  for (const double k : {0.0, 1e-6})
    for (const double n1 : kOuter)
      for (const double contrast : kContrasts) {
        const Rounded<TypeParam> in(1, n1, contrast);
        const Real want = std::norm(fromContrast(1, in.exactN1, in.exactContrast, R(k)).rs);
        worst.add((O::schlickReflectanceWith(1, in.n1, in.n2, R(k), in.contrast) - want) / want);
      }
  EXPECT_LT(worst.value(), 20);
}

TYPED_TEST(ContrastTest, ThinGlass) {
  MALUS_TYPES;
  Worst worst("pane", double(kEps));
  forEachContrast<TypeParam>([&](const auto& in) {
    const auto terms = O::refractionTermsWith(in.c, in.n1, in.n2, in.contrast);
    if (terms.total) return;
    const auto got = O::thinGlassFromTerms(in.c, terms, 1);
    // Without absorption R' = 2 R/(1 + R).
    const Amplitudes want = fromContrast(in.exactC, in.exactN1, in.exactContrast, 0);
    const Real rs = std::norm(want.rs);
    worst.add((got.reflected.rs - 2 * rs / (1 + rs)) / rs);
  });
  EXPECT_LT(worst.value(), 40);
}

// Airy's sum of the two interfaces, each from its contrast.
TYPED_TEST(ContrastTest, Film) {
  MALUS_TYPES;
  Worst worst("film", double(kEps));
  struct Case {
    double film, base;  // over the outer index
  };
  for (const Case& contrasts : {Case{1e-6, 3e-6}, Case{2e-7, -5e-6}, Case{-3e-7, 1e-6}, Case{0.5, 0.5000002},
                                Case{0.4999999, 0.5}, Case{1e-6, 0.5}, Case{-2e-7, 0.5}})
    for (const double n1 : kOuter)
      for (const double c : {1.0, 0.9, 0.5, 0.1}) {
        typename O::FilmLayers l{};
        l.n1 = R(n1);
        l.nf = R(n1 + contrasts.film);
        l.n3 = R(n1 + contrasts.base);
        l.filmStep = R(contrasts.film);
        l.baseStep = R(contrasts.base);
        l.filmOverBase = R(contrasts.film - contrasts.base);
        l.roundTripPhase = R(0.25 / n1);
        const auto got = O::filmResponse(R(c), l).reflected;
        const Real outer = l.n1, cosine = R(c), nf = outer + Real(l.filmStep);
        const Complex q2 = std::sqrt(Complex(Real(l.filmStep) * (nf + outer) / (outer * outer) + cosine * cosine));
        const Complex first = fromContrast(cosine, outer, l.filmStep, 0).rs;
        // The second interface seen from the film: its cosine there is n1 q2/nf.
        const Complex second = fromContrast((outer * q2 / nf).real(), nf, -Real(l.filmOverBase), 0).rs;
        const Complex phase = std::exp(Complex(0, -2 * kPi * Real(l.roundTripPhase)) * outer * q2);
        const Real want = std::norm((first + second * phase) / (Real(1) + first * second * phase));
        // The two amplitudes may nearly cancel: relative to what the larger one reflects.
        const Real size = std::max(std::norm(first), std::norm(second));
        worst.add((got.rs - want) / size);
      }
  EXPECT_LT(worst.value(), 60);
}

TYPED_TEST(ContrastTest, RefractedDirection) {
  MALUS_TYPES;
  const real c = R(0.5), sine = std::sqrt(R(0.75));
  const real3 d = O::make3(sine, 0, -c), n = O::make3(0, 0, 1);
  for (const double contrast : {1e-4, 1e-6, -1e-6}) {
    const Rounded<TypeParam> in(0.5, 1.5, contrast);
    const auto terms = O::refractionTermsWith(c, in.n1, in.n2, in.contrast);
    const real3 through = O::refractedDirectionFromTerms(d, n, c, terms);
    const Real eta = (in.exactN1 + in.exactContrast) / in.exactN1;
    EXPECT_CLOSE(through.x, sine / eta, 4 * kEps);
    EXPECT_LT((through.x - sine) * contrast, 4 * kEps * std::abs(contrast));
  }
}

TYPED_TEST(ContrastTest, SchlickWithoutInterfaceReflectsNothing) {
  MALUS_TYPES;
  for (const double n : {1e-3, 1.0, 1.5, 1e3})
    for (const real c : {R(0), R(1e-6L), R(0.1L), R(0.5L), R(0.99L), R(1)})
      EXPECT_EQ(O::schlickReflectance(c, R(n), R(n), 0), 0) << n << ' ' << c;
  // A contrast that the rounded indices do not show is an interface, and so is absorption.
  EXPECT_GT(O::schlickReflectanceWith(R(0.1L), 1, 1, 0, R(1e-12L)), 0);
  EXPECT_GT(O::schlickReflectance(R(0.1L), 1, 1, R(1e-3L)), 0);
  // Extreme ratios: straight through a very small index at normal incidence.
  const Real f0 = (1e3L - 1e-3L) / (1e3L + 1e-3L);
  EXPECT_CLOSE(O::schlickReflectance(1, R(1e3L), R(1e-3L), 0), f0 * f0, 8 * kEps);
}

}  // namespace
}  // namespace malus::test
