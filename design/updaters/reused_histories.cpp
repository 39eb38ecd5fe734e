#include "design/updaters/reused_histories.h"

#include <algorithm>
#include <utility>

#include "core/base/error.h"
#include "design/problem/merit.h"
#include "tracer/scene/refined_density.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

/// A record that is worth less than this adds noise of rare heavy weights rather than knowledge.
constexpr double kWorthless = 0.02;

/// Of photons that are not recorded: what the map of all is beside that of the records, a photon.
core::Tally rest_of(const RecordedTrace& trace) {
  const tracer::ArrivalRecords& records = *trace.records;
  if (records.photons() >= trace.photons) return core::Tally(0);
  const core::Tally own = records.at(records.density()).luminance;
  core::Tally rest(own.bins());
  for (std::size_t b = 0; b < own.batches(); ++b) {
    std::vector<double> difference(own.bins());
    for (std::size_t i = 0; i < difference.size(); ++i) {
      difference[i] = trace.luminance.batch(b)[i] / static_cast<double>(trace.photons) -
                      own.batch(b)[i] / static_cast<double>(records.photons());
    }
    rest.add_batch(std::move(difference));
  }
  return rest;
}

/// The density on the cells that were traced: finer ones where it runs linearly within a cell.
tracer::Reweighted at_density(const tracer::ArrivalRecords& records, const tracer::DensityField& density) {
  return records.at(refined(density, records.density().cells.grid.nx / density.cells.grid.nx));
}

}  // namespace

double worth_of(const RecordedTrace& trace, double effective_share) {
  const double recorded = static_cast<double>(trace.records->photons());
  const double all = std::max(static_cast<double>(trace.photons), recorded);
  return 1.0 / ((1.0 / std::max(effective_share, 1e-12) - 1.0) / recorded + 1.0 / all);
}

ReusedHistories::ReusedHistories(const DesignState& state, const DesignSpec& spec)
    : state_(state), target_(spec, state.observation.map.luminance.grid), traces_(state.recorded) {
  if (traces_.empty()) throw core::Error("no histories are recorded");
  for (const RecordedTrace& trace : traces_) rest_.push_back(rest_of(trace));
}

ReusedView ReusedHistories::at(const tracer::DensityField& density) const {
  const std::size_t batches = traces_.back().luminance.batches(), bins = traces_.back().luminance.bins();
  std::vector<std::vector<double>> sums(batches, std::vector<double>(bins, 0.0));
  double worth = 0.0;
  for (std::size_t k = 0; k < traces_.size(); ++k) {
    const bool newest = k + 1 == traces_.size();
    const tracer::Reweighted moved = at_density(*traces_[k].records, density);
    const double share = moved.effective_share;
    if (share < kWorthless && !newest) continue;
    const double per_photon = 1.0 / static_cast<double>(moved.photons);
    const double weight = worth_of(traces_[k], share);
    for (std::size_t b = 0; b < batches; ++b) {
      for (std::size_t i = 0; i < bins; ++i) {
        double value = moved.luminance.batch(b)[i] * per_photon;
        if (rest_[k].bins() > 0) value += rest_[k].batch(b)[i];
        sums[b][i] += weight * value;
      }
    }
    worth += weight;
  }
  const double photons = static_cast<double>(traces_.back().photons);
  const double unit = state_.observation.luminance_unit;
  ReusedView view{{density, {}, {}}, worth / photons};
  Observation& seen = view.state.observation;
  seen.photons = static_cast<std::uint64_t>(worth);
  seen.luminance = core::Tally(bins);
  for (auto& batch : sums) {
    for (double& value : batch) value *= photons / worth;
    seen.luminance.add_batch(std::move(batch));
  }
  seen.luminance_unit = unit;
  const core::CellGrid& grid = state_.observation.map.luminance.grid;
  seen.map = {{grid, 0.0}, {grid, 0.0}};
  const std::vector<core::Estimate> totals = seen.luminance.totals();
  for (std::size_t i = 0; i < bins; ++i) {
    seen.map.luminance.values[i] = totals[i].value * unit;
    seen.map.standard_error.values[i] = totals[i].se * unit;
  }
  const Evenness even = evenness(target_.judged(seen.luminance));
  view.state.record.rms = even.rms;
  view.state.record.rms_corrected = even.rms_corrected;
  target_.flatten(seen);
  return view;
}

}  // namespace evenglow::design
