#pragma once

#include <cstddef>
#include <vector>

#include "core/montecarlo/estimate.h"

/// Squared quantities with the noise taken off, from batches.
namespace evenglow::design {

/// Products h(b, c) of batches b and c, b > c; symmetric.
class BatchProducts {
 public:
  explicit BatchProducts(std::size_t batches) : batches_(batches), products_(batches * (batches + 1) / 2, 0.0) {}

  std::size_t batches() const { return batches_; }
  double& at(std::size_t b, std::size_t c) { return products_[b * (b + 1) / 2 + c]; }  ///< c <= b
  double at(std::size_t b, std::size_t c) const { return products_[b * (b + 1) / 2 + c]; }

 private:
  std::size_t batches_;
  std::vector<double> products_;
};

/// The mean of h(b, c) over b != c, the square of what the batches share without that of their noise (which is
/// independent from batch to batch). Its variance is that of a U-statistic of degree 2 (Hoeffding, Ann. Math. Stat. 19,
/// 1948), estimated from the matrix h: 4 (B - 2) / (B (B - 1)) zeta_1 + 2 / (B (B - 1)) zeta_2. At least 3 batches.
core::Estimate pair_statistic(const BatchProducts& h);

/// Root r with the sign kept, of a square C that is normal with the standard error s. Its error is 0.5 s/r where C is
/// well above s, and what signed roots scatter by, 0.893 sqrt(s), where C is lost in s; between, with u = |C|/s,
/// 0.5 sqrt(s / max(u - 1, 0.3133)): pulls of 1.3 at C = 0, 1.1 at s, 0.8 at 2 s to 5 s, 1 beyond. Decide on C and s.
core::Estimate signed_root(double square, double se);
/// The square that such a root was taken of, with its error: exact.
core::Estimate signed_square(const core::Estimate& root);

}  // namespace evenglow::design
