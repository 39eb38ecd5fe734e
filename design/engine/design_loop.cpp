#include "design/engine/design_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "design/engine/level_search.h"
#include "design/problem/merit.h"
#include "design/updaters/updater.h"

namespace evenglow::design {
namespace {

constexpr double kSettledLevel = 0.05;
constexpr double kNoneYet = 1e9;       // worse than any RMS
constexpr double kRoughlyRight = 0.3;  // RMS below which the level is chosen
constexpr int kStallSteps = 4;
constexpr double kStallGain = 0.05;
constexpr double kWantedError = 0.15;  // of the RMS, over the RMS to reach

/// The Monte Carlo noise of a cell over the mean, as the RMS sees it.
double noise_of(const StepRecord& record) {
  const double corrected = record.rms_corrected.value * std::abs(record.rms_corrected.value);
  return std::sqrt(std::max(0.0, record.rms * record.rms - corrected));
}

bool reached(const StepRecord& record, const DesignSpec& spec) {
  return record.rms_corrected.value <= spec.stop_rms + record.rms_corrected.se &&
         record.rms_corrected.se <= 0.5 * spec.stop_rms;
}

bool level_rests(const DesignProgress& progress, const DesignSpec& spec, const Proposal& proposal) {
  if (spec.level) return true;
  return !progress.level_note.empty() && std::abs(std::log(proposal.level_change)) < kSettledLevel;
}

bool stalled(const std::vector<StepRecord>& steps, const DesignLimits& limits) {
  if (static_cast<int>(steps.size()) < kStallSteps + 2) return false;
  const auto recent = steps.end() - kStallSteps;
  if ((recent - 1)->photons < limits.largest_photons) return false;
  const auto less = [](const StepRecord& a, const StepRecord& b) {
    return a.rms_corrected.value < b.rms_corrected.value;
  };
  const double before = std::min_element(steps.begin(), recent, less)->rms_corrected.value;
  return std::min_element(recent, steps.end(), less)->rms_corrected.value > (1.0 - kStallGain) * before;
}

std::uint64_t next_photons(const StepRecord& record, const DesignSpec& spec, const DesignLimits& limits) {
  const double wanted = std::max(record.rms_corrected.value, spec.stop_rms);
  const bool noisy = noise_of(record) > wanted;
  const bool unsure = record.rms_corrected.se > kWantedError * wanted;
  const double growth = noisy || unsure ? spec.photon_growth : 1.0;
  return std::min(limits.largest_photons, static_cast<std::uint64_t>(static_cast<double>(record.photons) * growth));
}

std::string stop_reason(const DesignProgress& progress, const DesignSpec& spec, const DesignLimits& limits,
                        const Proposal& proposal) {
  const StepRecord& record = progress.steps.back();
  if (reached(record, spec) && level_rests(progress, spec, proposal)) {
    return fmt::format("reached: the noise-corrected RMS is {:.2f} +- {:.2f} % (wanted {:.2f} %)",
                       100.0 * record.rms_corrected.value, 100.0 * record.rms_corrected.se, 100.0 * spec.stop_rms);
  }
  if (stalled(progress.steps, limits)) {
    if (progress.best_rms >= kNoneYet)
      return "stalled: the noise of the traces hides the RMS (more photons would tell)";
    return fmt::format("stalled: no better than {:.2f} % in the last {} steps", 100.0 * progress.best_rms, kStallSteps);
  }
  if (record.step >= spec.max_steps) return fmt::format("max_steps: {} steps were made", spec.max_steps);
  return {};
}

void tell_limits(const Proposal& proposal, const DesignSpec& spec, DesignProgress& progress) {
  progress.limit_notes.clear();
  const double cells = static_cast<double>(proposal.density.cells.values.size());
  const auto tell = [&](int count, const char* limit, double value) {
    if (count == 0) return;
    progress.limit_notes.push_back(fmt::format("The {} limit of the density ({}) holds {} cells ({:.2f} %).", limit,
                                               value, count, 100.0 * count / cells));
  };
  tell(proposal.clipped_low, "lower", spec.density_min);
  tell(proposal.clipped_high, "upper", spec.density_max);
}

/// A new level begins a new hunt for the best step.
void change_level(const LevelChoice& choice, const DesignSpec& spec, Proposal& proposal, DesignProgress& progress) {
  progress.level_note = choice.note;
  for (double& density : proposal.density.cells.values) density *= choice.factor;
  proposal.density = tracer::clamped(std::move(proposal.density), spec.density_min, spec.density_max);
  proposal.level_change *= choice.factor;
  if (choice.factor != 1.0) progress.best_rms = kNoneYet;
}

}  // namespace

StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation) {
  const Evenness even = evenness(observation.luminance);
  StepRecord record;
  record.step = step;
  record.photons = observation.photons;
  record.rms = even.rms;
  record.rms_corrected = even.rms_corrected;
  record.efficiency = observation.efficiency;
  record.mean_density = density.cells.mean();
  record.luminance_mean = even.mean.value * observation.luminance_unit;
  record.cpu_s = observation.cpu_s;
  record.wall_s = observation.wall_s;
  return record;
}

FinalJudgment make_judgment(const Observation& observation) {
  const Evenness even = evenness(observation.luminance);
  FinalJudgment judgment;
  judgment.photons = observation.photons;
  judgment.rms = even.rms;
  judgment.rms_corrected = even.rms_corrected;
  judgment.uniformity_9 = uniformity_9(observation.map.luminance);
  judgment.uniformity_13 = uniformity_13(observation.map.luminance);
  judgment.luminance_mean = {even.mean.value * observation.luminance_unit, even.mean.se * observation.luminance_unit};
  judgment.luminance_center = center_luminance(observation.map.luminance);
  judgment.efficiency = observation.efficiency;
  return judgment;
}

DesignProgress start_design(tracer::DensityField density, const DesignSpec& spec, const DesignLimits& limits) {
  DesignProgress progress;
  progress.density = tracer::clamped(std::move(density), spec.density_min, spec.density_max);
  progress.best_density = progress.density;
  progress.photons = std::min(limits.first_photons, limits.largest_photons);
  return progress;
}

DesignProgress run_design(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits,
                          DesignProgress progress, const StepObserver& observer) {
  const auto updater = make_updater(spec.updater);
  while (progress.stop_reason.empty()) {
    const int step = static_cast<int>(progress.steps.size());
    DesignState state{progress.density, {}};
    auto observation = model(state.density, progress.photons, static_cast<std::uint32_t>(step));
    if (!observation) return progress;
    state.observation = std::move(*observation);
    const StepRecord record = make_step_record(step, state.density, state.observation);
    DesignProgress before = progress;  // an interruption during the search of the level undoes the step
    progress.steps.push_back(record);
    if (step == 0) progress.start_luminance = state.observation.map.luminance;
    Proposal proposal = updater->propose(state, spec);
    const bool trusted = record.rms_corrected.se <= 0.5 * std::max(record.rms_corrected.value, spec.stop_rms);
    const double value = record.rms_corrected.value;
    const double se = record.rms_corrected.se;
    const bool clearly_better = value + 2.0 * se < progress.best_rms;
    if (step == 0 || clearly_better || (trusted && value < progress.best_rms + se) || reached(record, spec)) {
      progress.best_rms = trusted || clearly_better ? std::max(value, 0.0) : kNoneYet;
      progress.best_density = state.density;
    }
    tell_limits(proposal, spec, progress);
    if (progress.level_note.empty() && !spec.level && record.rms_corrected.value < kRoughlyRight) {
      const auto choice =
          choose_level(model, proposal.density, spec, std::min(limits.first_photons, limits.largest_photons));
      if (!choice) return before;
      change_level(*choice, spec, proposal, progress);
    }
    progress.stop_reason = stop_reason(progress, spec, limits, proposal);
    progress.density = std::move(proposal.density);
    progress.photons = next_photons(record, spec, limits);
    observer(record, progress);
  }
  return progress;
}

}  // namespace evenglow::design
