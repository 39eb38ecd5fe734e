#pragma once

#include <cstdint>
#include <vector>

#include "design/problem/design_state.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

/// The recorded traces that an updater may still use: the newest, and of the earlier ones those that fit into 512 MB.
/// The records themselves are not in the checkpoint, but what they were traced with is, in the memory of the updater.
class KeptRecords {
 public:
  /// Adds a trace of `density`, if it has records, and tells `memory` of all that are kept.
  void keep(const tracer::DensityField& density, const Observation& observation, std::uint32_t step,
            UpdaterMemory& memory);
  /// After an interruption: traces anew what `memory` tells of steps before `step`, to the same bits. `density`: any of
  /// the design, for its cells. False: interrupted.
  bool restore(const ForwardModel& model, tracer::DensityField density, std::uint32_t step, UpdaterMemory& memory);

  const std::vector<RecordedTrace>& traces() const { return traces_; }

 private:
  std::vector<RecordedTrace> traces_;
};

}  // namespace evenglow::design
