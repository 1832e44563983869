#include "bake/materials/dispersion.h"

#include <cmath>

namespace malus::bake {

namespace {

constexpr std::size_t kMostOfSum = 41;  // twenty terms

// The coefficients C1, C2, ... of the formulas.
class Coefficients {
 public:
  explicit Coefficients(std::span<const double> values) : values_(values) {}
  double operator[](std::size_t number) const { return number <= values_.size() ? values_[number - 1] : 0; }

  // Returns the sum of term(C_i, C_i+1) for i = first, first + 2, ...
  template <class Term>
  double sumOfPairs(std::size_t first, Term term) const {
    double sum = 0;
    for (std::size_t i = first; i <= values_.size(); i += 2) sum += term((*this)[i], (*this)[i + 1]);
    return sum;
  }

 private:
  std::span<const double> values_;
};

// C_i L^C_i+1/(L^2 - C_i+2^C_i+3); a term without a factor is left out, as 0^0 would be 1.
double resonance(const Coefficients& c, std::size_t i, double wavelength) {
  if (c[i] == 0) return 0;
  return c[i] * std::pow(wavelength, c[i + 1]) / (wavelength * wavelength - std::pow(c[i + 2], c[i + 3]));
}

}  // namespace

bool hasCompleteTerms(int formula, std::size_t coefficients) {
  switch (formula) {
    case 4:  // C1, two resonances of four, then pairs
      return coefficients == 1 || coefficients == 5 ||
             (coefficients >= 9 && coefficients % 2 == 1 && coefficients <= kMostOfSum);
    case 7:
    case 9:
      return coefficients >= 1 && coefficients <= 6;
    case 8:
      return coefficients >= 1 && coefficients <= 4;
    default:  // C1, then pairs
      return coefficients % 2 == 1 && coefficients <= kMostOfSum;
  }
}

double indexByFormula(int formula, std::span<const double> coefficients, double micrometres) {
  const Coefficients c(coefficients);
  const double l = micrometres, l2 = l * l;
  const auto power = [&](double factor, double exponent) { return factor * std::pow(l, exponent); };
  switch (formula) {
    case 1:
      return std::sqrt(1 + c[1] + c.sumOfPairs(2, [&](double b, double root) { return b * l2 / (l2 - root * root); }));
    case 2:
      return std::sqrt(1 + c[1] + c.sumOfPairs(2, [&](double b, double square) { return b * l2 / (l2 - square); }));
    case 3:
      return std::sqrt(c[1] + c.sumOfPairs(2, power));
    case 4:
      return std::sqrt(c[1] + resonance(c, 2, l) + resonance(c, 6, l) + c.sumOfPairs(10, power));
    case 5:
      return c[1] + c.sumOfPairs(2, power);
    case 6:
      return 1 + c[1] + c.sumOfPairs(2, [&](double b, double pole) { return b / (pole - 1 / l2); });
    case 7: {
      const double x = 1 / (l2 - 0.028);
      return c[1] + x * (c[2] + x * c[3]) + l2 * (c[4] + l2 * (c[5] + l2 * c[6]));
    }
    case 8: {
      const double x = c[1] + c[2] * l2 / (l2 - c[3]) + c[4] * l2;
      return std::sqrt((1 + 2 * x) / (1 - x));
    }
    default: {
      const double d = l - c[5];
      return std::sqrt(c[1] + c[2] / (l2 - c[3]) + c[4] * d / (d * d + c[6]));
    }
  }
}

}  // namespace malus::bake
