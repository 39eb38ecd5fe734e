#pragma once

#include <cstddef>
#include <vector>

#include "core/montecarlo/estimate.h"

namespace evenglow::core {

/// Results of equal batches of photons, bin by bin. A batch is one realization: means and standard errors come from the
/// spread of the batches. Unit: that of the receiver that the bins belong to.
class Tally {
 public:
  Tally() = default;
  explicit Tally(std::size_t bins) : bins_(bins) {}

  /// Adds the sums of one batch (size bins()).
  void add_batch(std::vector<double> sums);

  std::size_t bins() const { return bins_; }
  std::size_t batches() const { return batches_.size(); }
  const std::vector<double>& batch(std::size_t index) const { return batches_[index]; }

  /// Sum over all batches with the standard error of that sum: sqrt(B) times the standard deviation of the batches.
  Estimate total(std::size_t bin) const;
  /// The totals of all bins.
  std::vector<Estimate> totals() const;
  /// Total of the weighted sum of bins sum_i w_i x_i (correlations between bins are kept).
  Estimate weighted_total(const std::vector<double>& weights) const;

 private:
  std::size_t bins_ = 0;
  std::vector<std::vector<double>> batches_;
};

/// Sum of equal realizations with its standard error.
Estimate total_of_batches(const std::vector<double>& realizations);

}  // namespace evenglow::core
