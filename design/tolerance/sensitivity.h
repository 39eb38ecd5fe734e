#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/montecarlo/estimate.h"

/// What of a figure's spread comes from which parameter.
namespace evenglow::design {

/// Linear regression of a figure on all parameters that vary, together.
struct Sensitivity {
  /// Change of the figure, in its unit, for one standard deviation of each parameter, the others held; 0 +- 0 for one
  /// that does not vary.
  std::vector<core::Estimate> effects;
  double residual = 0.0;   ///< standard deviation of what the parameters leave unexplained, Monte Carlo noise included
  double explained = 0.0;  ///< share of the variance of the samples that the parameters explain (R^2, adjusted)
};

/// Ordinary least squares. `parameters`: a row for each sample. None where the samples are fewer than twice the
/// parameters and ten, or the parameters cannot be told apart.
std::optional<Sensitivity> sensitivity(const std::vector<std::vector<double>>& parameters,
                                       const std::vector<double>& figure);

}  // namespace evenglow::design
