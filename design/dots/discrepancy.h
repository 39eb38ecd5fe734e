#pragma once

#include <vector>

#include "design/dots/sample_windows.h"

namespace evenglow::design {

/// Squared L2 star discrepancy of a window's dots against its own linear density:
///   D = integral over the unit square of (A(x, y) / N - F(x, y))^2,
/// A the number of dots in [0, x) x [0, y), F the share of the density there (xy for an even one). Closed form after
/// Warnock (Applications of Number Theory to Numerical Analysis, 1972), here for a linear density; N^2 terms.
double squared_discrepancy(const SampleWindow& window);

/// Published limit of D for patterns without visible unevenness: 0.13 N^-1.15 (Ide et al., US 6,865,325, eq. 1).
double accepted_discrepancy(double count);

/// What chance gives on average for an even density: (1/4 - 1/9) / N.
double random_discrepancy(double count);

struct DiscrepancyStatistics {
  std::size_t windows = 0;
  std::size_t accepted = 0;  ///< windows within the published limit
  double mean_count = 0.0;   ///< dots in a window
  double mean_ratio = 0.0;   ///< of D to the limit
  double worst_ratio = 0.0;
};

DiscrepancyStatistics discrepancy_statistics(const std::vector<SampleWindow>& windows, int threads);

}  // namespace evenglow::design
