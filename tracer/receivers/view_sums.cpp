#include "tracer/receivers/view_sums.h"

#include <utility>
#include <vector>

namespace evenglow::tracer {

core::Tally sum_of_directions(const core::Tally& scores, std::size_t cells) {
  if (scores.bins() <= cells) return scores;
  core::Tally result(cells);
  for (std::size_t b = 0; b < scores.batches(); ++b) {
    const std::vector<double>& batch = scores.batch(b);
    std::vector<double> sums(cells, 0.0);
    for (std::size_t bin = 0; bin < batch.size(); ++bin) sums[bin % cells] += batch[bin];
    result.add_batch(std::move(sums));
  }
  return result;
}

core::Tally one_direction(const core::Tally& scores, std::size_t cells, std::size_t direction, double share) {
  core::Tally result(cells);
  for (std::size_t b = 0; b < scores.batches(); ++b) {
    const std::vector<double>& batch = scores.batch(b);
    std::vector<double> sums;
    sums.reserve(cells);
    for (std::size_t cell = 0; cell < cells; ++cell) sums.push_back(batch[direction * cells + cell] / share);
    result.add_batch(std::move(sums));
  }
  return result;
}

}  // namespace evenglow::tracer
