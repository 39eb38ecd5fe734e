#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/engine/photon_plan.h"
#include "design/engine/step_judgment.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/judgment.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

/// All that a design needs to go on from the end of a step.
struct DesignProgress {
  std::vector<StepRecord> steps;
  tracer::DensityField density;          ///< of the step to come
  std::uint64_t photons = 0;             ///< of the step to come
  core::CellField start_luminance;       ///< cd/m2, of step 0
  tracer::DensityField best_density;     ///< the best so far
  double best_rms = 0.0;                 ///< its noise-corrected RMS
  std::string stop_reason;               ///< not empty: the design has ended with `best_density`
  std::string level_note;                ///< how the level was chosen; empty: not yet
  double level_slope = 0.0;              ///< d ln efficiency / d ln level, as found then
  std::vector<std::string> limit_notes;  ///< which limits hold cells at the last step
  std::vector<std::string> notes;        ///< what the updater decided, in the order of the steps
  UpdaterMemory memory;                  ///< of the updater
};

/// Told of each finished step, with what it would take to go on from there.
using StepObserver = std::function<void(const StepRecord&, const DesignProgress&)>;

/// Where a design begins.
DesignProgress start_design(tracer::DensityField density, const DesignSpec& spec, const DesignLimits& limits);

/// Observe, judge, stop or propose. Returns the progress with a stop reason, or without one if the model was
/// interrupted; it can then be handed in again, and goes on to the same bits.
///
/// It ends where the rule of stop_rule.h says so. Once the shape is roughly right (noise-corrected RMS below 30 %,
/// seen, or foreseen by the updater of its next density) the level is chosen (level_search.h), unless the spec fixes
/// it; histories then tell how the shape changes with it. The photons of the next step: photon_plan.h.
DesignProgress run_design(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits,
                          DesignProgress progress, const StepObserver& observer);

}  // namespace evenglow::design
