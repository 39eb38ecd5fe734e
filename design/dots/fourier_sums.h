#pragma once

#include <vector>

#include <Eigen/Core>

namespace evenglow::design {

/// Frequencies first + k step for k = 0 .. count - 1.
struct FrequencyRow {
  double first = 0.0;
  double step = 1.0;
  int count = 1;
};

/// Sums over dots w exp(-2 pi i (fx x + fy y)) for all pairs of frequencies: entry (row, column) for fy, fx. One matrix
/// product of single precision; `w` empty: 1 each.
Eigen::MatrixXcf fourier_sums(const std::vector<double>& x, const std::vector<double>& y, const std::vector<double>& w,
                              const FrequencyRow& fx, const FrequencyRow& fy);

}  // namespace evenglow::design
