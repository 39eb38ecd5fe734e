#include "design/updaters/history_merit.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"
#include "design/updaters/reused_histories.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

/// Luminance a photon.
std::vector<double> per_photon(const core::Tally& tally, std::uint64_t photons) {
  std::vector<double> values;
  for (const core::Estimate& total : tally.totals()) values.push_back(total.value / static_cast<double>(photons));
  return values;
}

}  // namespace

HistoryMerit::HistoryMerit(const DesignState& state, const DesignSpec& spec) : level_(state.density.cells.mean()) {
  if (state.recorded.empty()) throw core::Error("no histories are recorded");
  trace_ = state.recorded.back();
  if (spec.level) level_ = *spec.level;
  const tracer::ArrivalRecords& records = *trace_.records;
  rest_ = per_photon(trace_.luminance, trace_.photons);
  const std::vector<double> own = per_photon(records.at(records.density()).luminance, records.photons());
  for (std::size_t i = 0; i < rest_.size(); ++i) rest_[i] -= own[i];
  const Target target(spec, state.observation.map.luminance.grid);
  for (const double t : target.relative().values) {
    inverse_target_.push_back(t > 0.0 ? 1.0 / t : 0.0);
    counted_ += t > 0.0 ? 1.0 : 0.0;
  }
}

HistoryMerit::Value HistoryMerit::at(const tracer::DensityField& density) const {
  const tracer::ArrivalRecords& records = *trace_.records;
  const tracer::Reweighted moved = records.at(density);
  std::vector<double> y = per_photon(moved.luminance, moved.photons);
  double mean = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i) mean += (y[i] = (y[i] + rest_[i]) * inverse_target_[i]) / counted_;
  Value value{0.0, {}, worth_of(trace_, moved.effective_share) / static_cast<double>(trace_.photons)};
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (inverse_target_[i] > 0.0) value.merit += std::pow(y[i] / mean - 1.0, 2) / counted_;
  }
  std::vector<double> slopes(y.size(), 0.0);  // of the merit with the records' own sum of L
  for (std::size_t i = 0; i < y.size(); ++i) {
    if (inverse_target_[i] > 0.0)
      slopes[i] = 2.0 / (counted_ * mean) * (y[i] / mean - 1.0 - value.merit) * inverse_target_[i] /
                  static_cast<double>(moved.photons);
  }
  value.gradient = records.gradient(density, slopes);
  const double sum = density.cells.mean() * static_cast<double>(density.cells.values.size());
  const double off = std::log(density.cells.mean() / level_);
  value.merit += off * off;
  for (std::size_t j = 0; j < value.gradient.values.size(); ++j)
    value.gradient.values[j] += 2.0 * off * density.cells.values[j] / sum;
  return value;
}

}  // namespace evenglow::design
