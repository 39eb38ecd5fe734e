#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"
#include "design/problem/judgment.h"

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
  std::vector<std::string> limit_notes;  ///< which limits hold cells at the last step
};

/// Told of each finished step, with what it would take to go on from there.
using StepObserver = std::function<void(const StepRecord&, const DesignProgress&)>;

struct DesignLimits {
  std::uint64_t first_photons = 0;
  std::uint64_t largest_photons = 0;
};

/// Where a design begins.
DesignProgress start_design(tracer::DensityField density, const DesignSpec& spec, const DesignLimits& limits);

/// Observe, judge, stop or propose. Returns the progress with a stop reason, or without one if the model was
/// interrupted; it can then be handed in again.
///
/// Once the shape is roughly right (noise-corrected RMS below 30 %) the level is chosen (level_search.h), unless the
/// spec fixes it. Stops when the noise-corrected RMS is below `stop_rms` plus its standard error and the level rests;
/// when no step of the last four was better by 5 % at the largest number of photons; or after `max_steps`.
DesignProgress run_design(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits,
                          DesignProgress progress, const StepObserver& observer);

/// The row of the convergence table for an observation.
StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation);

/// The judgment from a trace with fresh random numbers.
FinalJudgment make_judgment(const Observation& observation);

}  // namespace evenglow::design
