#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "design/engine/photon_plan.h"
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
/// One stopping rule for all updaters. The design ends when the noise-corrected RMS of luminance over target is below
/// `stop_rms` plus its standard error, that error is at most half of `stop_rms`, and the level rests; when the steps of
/// the updater's patience (4; more for searches) brought no gain of 5 % at the largest number of photons, or with
/// less noise in a cell than RMS; or after
/// `max_steps`. Once the shape is roughly right (noise-corrected RMS below 30 %, seen, or foreseen by the updater of
/// its next density) the level is chosen (level_search.h), unless the spec fixes it; histories then tell how the shape
/// changes with it.
/// The photons of the next step: photon_plan.h.
DesignProgress run_design(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits,
                          DesignProgress progress, const StepObserver& observer);

/// The row of the convergence table for an observation.
StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation,
                            const DesignSpec& spec);

/// The judgment from a trace with fresh random numbers. Its RMS is that of luminance over target, over the cells that
/// count.
FinalJudgment make_judgment(const Observation& observation, const DesignSpec& spec);

}  // namespace evenglow::design
