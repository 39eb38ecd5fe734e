#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "design/engine/design_loop.h"

/// How fast each updater reaches an evenness, under one stopping rule.
namespace evenglow::design {

/// What it took until a trace showed a noise-corrected RMS at or below a threshold, with a standard error of at most
/// half of it. That trace is not among those that made its density, so that nothing flatters it; it is counted.
struct Effort {
  int steps = 0;  ///< updates made
  std::uint64_t photons = 0;
  double cpu_s = 0.0;  ///< of traces and updates
};

struct MethodTrial {
  std::string updater;
  std::uint64_t seed = 0;
  std::vector<std::optional<Effort>> efforts;  ///< for each threshold
  std::vector<StepRecord> steps;
  std::vector<double> cpu_s;  ///< up to the end of each step
  Effort spent;               ///< in all, the judging trace apart
  std::string stop_reason;
  FinalJudgment judged;  ///< of the best density
};

/// What a trial may take.
struct TrialLimits : DesignLimits {
  double cpu_s = 0.0;                           ///< no trace begins after so many CPU seconds; 0: no limit
  std::uint64_t judging_photons = 0;            ///< 0: the largest of a step
  const ForwardModel* judging_model = nullptr;  ///< null: that of the design
};

/// One design with the updater of the spec. Empty: interrupted.
std::optional<MethodTrial> run_trial(const ForwardModel& model, const DesignSpec& spec, const TrialLimits& limits,
                                     const tracer::DensityField& start, const std::vector<double>& thresholds);

/// The efforts of an updater at a threshold over the seeds; medians of those that reached it.
struct EffortSummary {
  int trials = 0;
  int reached = 0;
  double steps = 0.0, steps_low = 0.0, steps_high = 0.0;  ///< median, least, greatest
  double photons = 0.0, photons_low = 0.0, photons_high = 0.0;
  double cpu_s = 0.0, cpu_low = 0.0, cpu_high = 0.0;
  Effort in_vain;  ///< the least that a trial which did not reach it had spent; 0: all reached it
};
EffortSummary summarize(const std::vector<MethodTrial>& trials, const std::string& updater, std::size_t threshold);

}  // namespace evenglow::design
