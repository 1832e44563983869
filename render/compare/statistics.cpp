#include "render/compare/statistics.h"

#include <algorithm>
#include <cmath>

namespace malus::render {

double quantile(std::vector<double> values, double q) {
  std::sort(values.begin(), values.end());
  const double at = q * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(at);
  const std::size_t above = std::min(below + 1, values.size() - 1);
  return values[below] + (at - static_cast<double>(below)) * (values[above] - values[below]);
}

Spread computeSpread(const std::vector<double>& values) {
  return {quantile(values, 0.5), quantile(values, 0.25), quantile(values, 0.75)};
}

Spread ratioSpread(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> ratios;
  for (std::size_t i = 0; i < a.size(); ++i) ratios.push_back(a[i] / b[i]);
  return computeSpread(ratios);
}

bool differSignificantly(const std::vector<double>& a, const std::vector<double>& b) {
  int rounds = 0, faster = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (a[i] == b[i]) continue;
    ++rounds;
    if (a[i] < b[i]) ++faster;
  }
  // Probability of a split that is at least as uneven: twice the tail of a fair binomial distribution.
  const int fewer = std::min(faster, rounds - faster);
  double tail = 0, choose = 1;
  for (int k = 0; k <= fewer; ++k) {
    tail += choose;
    choose = choose * (rounds - k) / (k + 1);
  }
  return 2 * tail / std::exp2(rounds) <= 0.05;
}

}  // namespace malus::render
