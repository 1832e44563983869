// Medians and spreads of repeated measurements.
#pragma once

#include <vector>

namespace malus::render {

// Quantile by linear interpolation between order statistics (Hyndman and Fan 1996, type 7). values: not empty.
double quantile(std::vector<double> values, double q);

struct Spread {
  double median = 0, low = 0, high = 0;  // low, high: quartiles
};
// Median and quartiles. values: not empty.
Spread computeSpread(const std::vector<double>& values);

// Spread of a[i] / b[i], round by round: a slow round cancels. Equal lengths.
Spread ratioSpread(const std::vector<double>& a, const std::vector<double>& b);

// Two-sided sign test at 5 % on paired measurements: whether one of the two was faster in enough rounds. False for
// fewer than six rounds. Equal lengths.
bool differSignificantly(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace malus::render
