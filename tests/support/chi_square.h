#pragma once

#include <span>

namespace evenglow::tests {

/// Chance that a chi-square variable of `degrees` degrees of freedom passes `statistic`: the regularized upper
/// incomplete gamma function Q(degrees / 2, statistic / 2).
double chi_square_tail(double statistic, double degrees);

struct ChiSquareResult {
  double statistic = 0.0;
  int degrees = 0;
  double p_value = 1.0;  ///< chance of at least this statistic if the counts follow the expectation
};

/// Pearson's test of counts against expected counts of the same total (the total is data: one degree of freedom goes).
/// Bins that expect fewer than `least` are pooled with their followers, which keeps the statistic close to its
/// distribution.
ChiSquareResult chi_square_test(std::span<const double> counts, std::span<const double> expected, double least = 20.0);

}  // namespace evenglow::tests
