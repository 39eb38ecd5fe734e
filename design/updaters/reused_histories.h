#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/target.h"

namespace evenglow::design {

/// Photons that the trace is worth at a density where its records have this effective share: from the variance of
/// L + R(d) - R(d0) below. With weights W of mean 1 that is E[(W - 1)^2] = 1/share - 1 for a recorded photon, 1 for a
/// traced one.
double worth_of(const RecordedTrace& trace, double effective_share);

/// What recorded histories say of a density that was not traced.
struct ReusedView {
  DesignState state;             ///< its luminance over the target, as `Updater::propose` sees it
  double effective_share = 0.0;  ///< photons that the traces are worth there, over those of the newest
};

/// The traces of a design so far whose histories are recorded, as a forward model without photons: each record is
/// re-weighted to the density in question (tracer/transport/arrival_records.h), and the maps are averaged with the
/// weights of the photons that they are worth there. Where a trace has more photons than records, its own map L stands
/// beside that of its records R: L + R(d) - R(d0), d0 the traced density (a control variate: at d0 the map of all
/// photons, and close to it nearly as good, however few are recorded). Worth 1/((1/s - 1)/recorded + 1/all), s the
/// effective share of the records.
class ReusedHistories {
 public:
  /// `state`: a step with records; Error without.
  ReusedHistories(const DesignState& state, const DesignSpec& spec);

  ReusedView at(const tracer::DensityField& density) const;

 private:
  const DesignState& state_;
  Target target_;
  std::vector<RecordedTrace> traces_;  ///< the newest last
  std::vector<core::Tally> rest_;      ///< L - R(d0) of each, a photon; no bins where all photons are recorded
};

}  // namespace evenglow::design
