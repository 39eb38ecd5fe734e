#pragma once

#include <vector>

#include "core/montecarlo/estimate.h"

/// What samples with a Monte Carlo noise of their own tell of the population that they were drawn from.
namespace evenglow::design {

/// One figure over all samples.
struct Population {
  std::size_t count = 0;
  core::Estimate mean;      ///< of the population, as seen
  double seen = 0.0;        ///< standard deviation of the samples, noise included
  double noise = 0.0;       ///< root of the mean squared standard error of a sample
  core::Estimate spread;    ///< standard deviation without the noise; signed root, < 0 where noise explains more
  double spread_low = 0.0;  ///< 95 % confidence interval: that of the variance, which is nearly normal, signed roots
  double spread_high = 0.0;
  double least = 0.0, median = 0.0, greatest = 0.0;  ///< of the samples as seen
};

/// The variance of the population is that of the samples less their mean squared standard error: unbiased where the
/// noise of a sample is independent of its value and of the others. The variance of the samples' variance s^2 is
/// (m4 - (n - 3) / (n - 1) s^4) / n (Cramer, Mathematical Methods of Statistics, 1946, eq. 27.4.2); that of the noise,
/// the variance of the squared errors over n, is added. Samples whose noise is common (`common`) are taken as they are:
/// what is common shifts them all. At least 3 samples, finite.
Population population_of(const std::vector<core::Estimate>& samples, bool common = false);

/// The samples with as much spread as the population has: each moved towards the mean by the factor `spread` / `seen`,
/// none left where the noise explains all (Louis, J. Am. Stat. Assoc. 79, 1984: such estimates have the ensemble's own
/// distribution, which neither the samples nor their single best estimates have); then by `shift` less.
std::vector<double> without_noise(const std::vector<core::Estimate>& samples, const Population& population,
                                  double shift = 0.0);

}  // namespace evenglow::design
