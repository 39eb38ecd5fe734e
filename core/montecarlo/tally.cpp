#include "core/montecarlo/tally.h"

#include <cmath>
#include <utility>

#include "core/base/error.h"

namespace evenglow::core {

void Tally::add_batch(std::vector<double> sums) {
  expects(sums.size() == bins_, "a batch has a sum for each bin");
  batches_.push_back(std::move(sums));
}

Estimate total_of_batches(const std::vector<double>& realizations) {
  const double count = static_cast<double>(realizations.size());
  double sum = 0.0;
  for (const double x : realizations) sum += x;
  const double mean = sum / count;
  double squares = 0.0;
  for (const double x : realizations) squares += (x - mean) * (x - mean);
  const double variance = realizations.size() > 1 ? squares / (count - 1.0) : 0.0;
  return {sum, std::sqrt(variance * count)};
}

Estimate Tally::total(std::size_t bin) const {
  std::vector<double> realizations;
  realizations.reserve(batches_.size());
  for (const auto& batch : batches_) realizations.push_back(batch[bin]);
  return total_of_batches(realizations);
}

std::vector<Estimate> Tally::totals() const {
  std::vector<Estimate> result;
  result.reserve(bins_);
  for (std::size_t bin = 0; bin < bins_; ++bin) result.push_back(total(bin));
  return result;
}

Estimate Tally::weighted_total(const std::vector<double>& weights) const {
  expects(weights.size() == bins_, "a weight for each bin");
  std::vector<double> realizations;
  realizations.reserve(batches_.size());
  for (const auto& batch : batches_) {
    double sum = 0.0;
    for (std::size_t bin = 0; bin < bins_; ++bin) sum += weights[bin] * batch[bin];
    realizations.push_back(sum);
  }
  return total_of_batches(realizations);
}

}  // namespace evenglow::core
