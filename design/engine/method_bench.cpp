#include "design/engine/method_bench.h"

#include <algorithm>
#include <utility>

#include <fmt/core.h>

#include "core/montecarlo/batches.h"
#include "design/engine/traced_model.h"

namespace evenglow::design {
namespace {

struct Spread {
  double median, low, high;
};

Spread spread_of(std::vector<double> values) {
  if (values.empty()) return {0.0, 0.0, 0.0};
  std::sort(values.begin(), values.end());
  const std::size_t n = values.size();
  return {0.5 * (values[(n - 1) / 2] + values[n / 2]), values.front(), values.back()};
}

/// The model, up to a CPU time of the process; `spent` tells that it said no.
ForwardModel within_budget(const ForwardModel& model, double until, bool bounded, bool& spent) {
  if (!bounded) return model;
  const auto limited = [&spent, until](const auto& trace) {
    return [&spent, &trace, until](const tracer::DensityField& density, std::uint64_t photons,
                                   std::uint32_t step) -> std::optional<Observation> {
      spent = core::process_cpu_seconds() > until;
      if (spent) return std::nullopt;
      return trace(density, photons, step);
    };
  };
  ForwardModel result = limited(model);
  if (model.recording) result.recording = limited(model.recording);
  return result;
}

}  // namespace

std::optional<MethodTrial> run_trial(const ForwardModel& model, const DesignSpec& spec, const TrialLimits& limits,
                                     const tracer::DensityField& start, const std::vector<double>& thresholds) {
  MethodTrial trial;
  trial.updater = spec.updater;
  trial.efforts.resize(thresholds.size());
  const double begin = core::process_cpu_seconds();
  std::uint64_t photons = 0;
  const auto observer = [&](const StepRecord& record, const DesignProgress&) {
    photons += record.photons + record.level_photons;
    trial.cpu_s.push_back(core::process_cpu_seconds() - begin);
    for (std::size_t i = 0; i < thresholds.size(); ++i) {
      const bool shown = record.rms_corrected.value <= thresholds[i] && record.rms_corrected.se <= 0.5 * thresholds[i];
      if (shown && !trial.efforts[i]) trial.efforts[i] = Effort{record.step, photons, trial.cpu_s.back()};
    }
    trial.spent = {record.step, photons, trial.cpu_s.back()};
  };
  bool spent = false;
  const ForwardModel bounded = within_budget(model, begin + limits.cpu_s, limits.cpu_s > 0.0, spent);
  DesignProgress progress = run_design(bounded, spec, limits, start_design(start, spec, limits), observer);
  if (spent) progress.stop_reason = fmt::format("budget: {:g} CPU seconds were spent", limits.cpu_s);
  if (progress.stop_reason.empty() || progress.steps.empty()) return std::nullopt;
  const ForwardModel& judge = limits.judging_model != nullptr ? *limits.judging_model : model;
  const std::uint64_t last = limits.judging_photons > 0 ? limits.judging_photons : limits.largest_photons;
  const auto judging = judge(progress.best_density, last, kJudgingStep);
  if (!judging) return std::nullopt;
  trial.judged = make_judgment(*judging, spec);
  trial.steps = std::move(progress.steps);
  trial.stop_reason = std::move(progress.stop_reason);
  return trial;
}

EffortSummary summarize(const std::vector<MethodTrial>& trials, const std::string& updater, std::size_t threshold) {
  EffortSummary summary;
  std::vector<double> steps, photons, cpu;
  for (const MethodTrial& trial : trials) {
    if (trial.updater != updater) continue;
    ++summary.trials;
    const auto& effort = trial.efforts[threshold];
    if (!effort) {
      if (summary.in_vain.cpu_s == 0.0 || trial.spent.cpu_s < summary.in_vain.cpu_s) summary.in_vain = trial.spent;
      continue;
    }
    ++summary.reached;
    steps.push_back(effort->steps);
    photons.push_back(static_cast<double>(effort->photons));
    cpu.push_back(effort->cpu_s);
  }
  const Spread s = spread_of(std::move(steps)), p = spread_of(std::move(photons)), c = spread_of(std::move(cpu));
  summary.steps = s.median, summary.steps_low = s.low, summary.steps_high = s.high;
  summary.photons = p.median, summary.photons_low = p.low, summary.photons_high = p.high;
  summary.cpu_s = c.median, summary.cpu_low = c.low, summary.cpu_high = c.high;
  return summary;
}

}  // namespace evenglow::design
