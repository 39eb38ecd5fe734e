#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/target.h"

namespace evenglow::design {

/// What recorded histories say of a density that was not traced.
struct ReusedView {
  DesignState state;             ///< its luminance over the target, as `Updater::propose` sees it
  double effective_share = 0.0;  ///< histories that the records are worth, over those of the newest trace
};

/// The traces of a design so far whose histories are recorded, as a forward model without photons: each record is
/// re-weighted to the density in question (tracer/transport/arrival_records.h), and the maps are averaged with the
/// weights photons x effective share. Where a trace has more photons than records, its own map L stands beside that of
/// its records R: R(d) + b (L - R(d0)), d0 the traced density, b the effective share (a control variate: unbiased for
/// any b, and at d0 the map of all photons).
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
