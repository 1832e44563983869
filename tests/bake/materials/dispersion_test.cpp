// Dispersion formulas against published indices and hand-computed values.
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bake/materials/dispersion.h"

namespace malus::bake {
namespace {

TEST(Dispersion, SellmeierGivesTheCatalogueIndices) {
  // SCHOTT N-BK7: n_d = 1.51680 at 587.6 nm, n_F = 1.52238 at 486.1 nm (data sheet).
  const std::vector<double> bk7 = {0, 1.03961212, 0.00600069867, 0.231792344, 0.0200179144, 1.01046945, 103.560653};
  EXPECT_NEAR(indexByFormula(2, bk7, 0.5875618), 1.51680, 5e-6);
  EXPECT_NEAR(indexByFormula(2, bk7, 0.4861327), 1.52238, 5e-6);
  // Formula 1 has the roots of the squares.
  std::vector<double> roots = bk7;
  for (const std::size_t i : {2u, 4u, 6u}) roots[i] = std::sqrt(bk7[i]);
  EXPECT_NEAR(indexByFormula(1, roots, 0.5875618), 1.51680, 5e-6);
  // Fused silica: n_d = 1.45846 (Malitson 1965).
  const std::vector<double> silica = {0, 0.6961663, 0.0684043, 0.4079426, 0.1162414, 0.8974794, 9.896161};
  EXPECT_NEAR(indexByFormula(1, silica, 0.5875618), 1.45846, 5e-6);
}

TEST(Dispersion, GasesGiveTheIndexOfAir) {
  // P. E. Ciddor, Appl. Opt. 35, 1566 (1996): 1.00027716 at 589.3 nm, 15 C, dry air with 450 ppm of CO2.
  const std::vector<double> air = {0, 0.05792105, 238.0185, 0.00167917, 57.362};
  EXPECT_NEAR(indexByFormula(6, air, 0.5893), 1.00027716, 1e-7);
}

TEST(Dispersion, EachTermOfEachFormula) {
  // At a wavelength of 2 every term is a short fraction.
  const double l = 2;
  EXPECT_DOUBLE_EQ(indexByFormula(3, std::array{1.0, 2.0, 2.0, 3.0, -1.0}, l), std::sqrt(1 + 8 + 1.5));
  EXPECT_DOUBLE_EQ(indexByFormula(4, std::array{1.0, 2.0, 1.0, 1.5, 2.0, 3.0, 0.0, 3.0, 1.0, 0.5, 2.0, 1.0, -2.0}, l),
                   std::sqrt(1 + 4 / 1.75 + 3 / 1.0 + 2 + 0.25));
  EXPECT_DOUBLE_EQ(indexByFormula(5, std::array{1.5, 0.1, -2.0, 0.2, -4.0}, l), 1.5 + 0.025 + 0.0125);
  EXPECT_DOUBLE_EQ(indexByFormula(6, std::array{0.1, 3.0, 1.25}, l), 1.1 + 3);
  const double x = 1 / (4 - 0.028);
  EXPECT_DOUBLE_EQ(indexByFormula(7, std::array{1.5, 0.1, 0.2, 0.01, 0.02, 0.001}, l),
                   1.5 + 0.1 * x + 0.2 * x * x + 0.04 + 0.32 + 0.064);
  EXPECT_DOUBLE_EQ(indexByFormula(8, std::array{0.1, 0.2, 1.0, 0.01}, l),
                   std::sqrt((1 + 2 * (0.1 + 0.8 / 3 + 0.04)) / (1 - (0.1 + 0.8 / 3 + 0.04))));
  EXPECT_DOUBLE_EQ(indexByFormula(9, std::array{2.0, 0.3, 1.0, 0.5, 1.0, 1.5}, l), std::sqrt(2 + 0.1 + 0.5 / 2.5));
}

TEST(Dispersion, TermsAreComplete) {
  for (const int formula : {1, 2, 3, 5, 6})
    for (const std::size_t count : {1u, 3u, 7u}) {
      EXPECT_TRUE(hasCompleteTerms(formula, count)) << formula;
      EXPECT_FALSE(hasCompleteTerms(formula, count - 1)) << formula;
    }
  for (const std::size_t count : {1u, 5u, 9u, 11u, 17u}) EXPECT_TRUE(hasCompleteTerms(4, count)) << count;
  for (const std::size_t count : {0u, 2u, 3u, 7u, 8u, 10u, 43u}) EXPECT_FALSE(hasCompleteTerms(4, count)) << count;
  EXPECT_TRUE(hasCompleteTerms(7, 6) && hasCompleteTerms(8, 4) && hasCompleteTerms(9, 6));
  EXPECT_FALSE(hasCompleteTerms(7, 7) || hasCompleteTerms(8, 5) || hasCompleteTerms(9, 0));
}

TEST(Dispersion, MissingTermsAddNothing) {
  for (const int formula : {3, 4}) EXPECT_DOUBLE_EQ(indexByFormula(formula, std::array{2.25}, 0.5), 1.5) << formula;
  for (const int formula : {5, 7}) EXPECT_DOUBLE_EQ(indexByFormula(formula, std::array{1.5}, 0.5), 1.5) << formula;
  for (const int formula : {1, 2}) EXPECT_DOUBLE_EQ(indexByFormula(formula, std::array{1.25}, 0.5), 1.5) << formula;
  EXPECT_DOUBLE_EQ(indexByFormula(6, std::array{0.5}, 0.5), 1.5);
  EXPECT_DOUBLE_EQ(indexByFormula(8, std::array{0.25}, 0.5), std::sqrt(2));
  // A pole: no index.
  EXPECT_FALSE(std::isfinite(indexByFormula(2, std::array{0.0, 1.0, 0.25}, 0.5)));
  EXPECT_TRUE(std::isnan(indexByFormula(3, std::array{-1.0}, 0.5)));
}

}  // namespace
}  // namespace malus::bake
