#pragma once

#include <cmath>
#include <cstddef>

#include "core/montecarlo/estimate.h"

namespace evenglow::tests {

/// Chance of a false alarm for each of `comparisons` independent tests so that all together have the chance `alpha`
/// (Sidak): 1 - (1 - alpha)^(1 / comparisons).
inline double sidak(double alpha, std::size_t comparisons) {
  return -std::expm1(std::log1p(-alpha) / static_cast<double>(comparisons));
}

/// |z| of a normal variable that is passed with the chance `alpha`, both sides together.
double two_sided_z(double alpha);

/// Limit of |z| for `comparisons` tests with the chance `alpha` of one false alarm or more among them all.
inline double z_limit(double alpha, std::size_t comparisons) {
  return two_sided_z(sidak(alpha, comparisons));
}

/// (value - expected) / se; 0 where both difference and error are rounding.
inline double z_score(const core::Estimate& estimate, double expected) {
  const double difference = estimate.value - expected;
  const double rounding = 1e-12 * (1.0 + std::abs(expected));
  return std::abs(difference) <= rounding && estimate.se <= rounding ? 0.0 : difference / estimate.se;
}

/// `hits` of `trials` against the chance `p`: z with the binomial standard error of p.
inline double binomial_z(double hits, double trials, double p) {
  const double se = std::sqrt(p * (1.0 - p) / trials);
  return z_score({hits / trials, se}, p);
}

}  // namespace evenglow::tests
