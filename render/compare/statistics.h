// Medians and spreads of repeated measurements.
#pragma once

#include <vector>

namespace malus::render {

// Quantile by linear interpolation between order statistics (Hyndman and Fan 1996, type 7). values: not empty.
double quantile(std::vector<double> values, double q);

struct Spread {
  double median = 0, low = 0, high = 0;  // low, high: quartiles
};
Spread spreadOf(const std::vector<double>& values);

// Spread of a[i] / b[i]: round by round, so that what slows a whole round cancels. Equal lengths.
Spread ratioSpread(const std::vector<double>& a, const std::vector<double>& b);

// Whether paired measurements leave open which of the two is faster: neither was faster in enough rounds for
// a two-sided sign test at 5 % (fewer than six rounds never are enough).
bool indistinguishable(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace malus::render
