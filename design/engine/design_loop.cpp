#include "design/engine/design_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "core/montecarlo/batches.h"
#include "design/engine/level_search.h"
#include "design/engine/photon_plan.h"
#include "design/problem/density_limits.h"
#include "design/problem/merit.h"
#include "design/problem/target.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::design {
namespace {

constexpr double kSettledLevel = 0.05;
constexpr double kNoneYet = 1e9;       // worse than any RMS
constexpr double kRoughlyRight = 0.3;  // RMS below which the level is chosen
constexpr double kStallGain = 0.05;
constexpr double kLevelStep = 1.25;                       // largest factor of a correction of the level
constexpr const char* kRecordedSteps = "recorded_steps";  // in the memory: step, photons and density of each
constexpr std::size_t kMostRecordBytes = std::size_t{512} << 20;
constexpr double kLeastSlope = 0.05;  // below it the efficiency does not hear the level

bool reached(const StepRecord& record, const DesignSpec& spec) {
  return record.rms_corrected.value <= spec.stop_rms + record.rms_corrected.se &&
         record.rms_corrected.se <= 0.5 * spec.stop_rms;
}

bool level_rests(const DesignProgress& progress, const DesignSpec& spec, const Proposal& proposal) {
  if (spec.level) return true;
  return !progress.level_note.empty() && std::abs(std::log(proposal.level_change)) < kSettledLevel;
}

bool stalled(const std::vector<StepRecord>& steps, const DesignLimits& limits, int patience) {
  if (static_cast<int>(steps.size()) < patience + 2) return false;
  const auto recent = steps.end() - patience;
  // More photons would help where noise may hide what is left.
  const StepRecord& first = *(recent - 1);
  if (first.photons < limits.largest_photons && first.rms_corrected.value < first.noise) return false;
  const auto less = [](const StepRecord& a, const StepRecord& b) {
    return a.rms_corrected.value < b.rms_corrected.value;
  };
  const double before = std::min_element(steps.begin(), recent, less)->rms_corrected.value;
  return std::min_element(recent, steps.end(), less)->rms_corrected.value > (1.0 - kStallGain) * before;
}

/// One design: the loop of `run_design`, a step at a time.
class Loop {
 public:
  Loop(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits, DesignProgress progress)
      : model_(model),
        spec_(spec),
        limits_(limits),
        updater_(make_updater(spec.updater)),
        progress_(std::move(progress)) {}

  bool finished() const { return !progress_.stop_reason.empty(); }
  DesignProgress take() { return std::move(progress_); }

  /// False: interrupted, and nothing has changed.
  bool step(const StepObserver& observer) {
    auto state = observe();
    if (!state) return false;
    DesignProgress before = progress_;  // an interruption during the search of the level undoes the step
    StepRecord& record = state->record;
    const double cpu = core::process_cpu_seconds();
    Proposal proposal = updater_->propose(*state, spec_, progress_.memory);
    if (updater_->wants_records()) record.cpu_s += core::process_cpu_seconds() - cpu;
    record.updater = proposal.method.empty() ? spec_.updater : proposal.method;
    record.held_low = proposal.clipped_low;
    record.held_high = proposal.clipped_high;
    progress_.steps.push_back(record);
    keep_best(record, state->density);
    if (!settle_level(*state, proposal)) {
      progress_ = std::move(before);
      return false;
    }
    if (!proposal.note.empty()) progress_.notes.push_back(fmt::format("Step {}: {}", record.step, proposal.note));
    tell_limits(proposal);
    progress_.stop_reason = stop_reason(proposal);
    progress_.photons =
        next_photons(progress_.steps, foresight_of(proposal), progress_.start_luminance.values.size(), spec_, limits_);
    progress_.density = std::move(proposal.density);
    observer(progress_.steps.back(), progress_);
    return true;
  }

 private:
  std::optional<DesignState> observe() {
    const int number = static_cast<int>(progress_.steps.size());
    const auto step = static_cast<std::uint32_t>(number);
    if (records_wanted() && !restore_records(step)) return std::nullopt;
    auto observation = records_wanted() ? model_.recording(progress_.density, progress_.photons, step)
                                        : model_(progress_.density, progress_.photons, step);
    if (!observation) return std::nullopt;
    keep_records(*observation, step);
    DesignState state{progress_.density, std::move(*observation)};
    state.recorded = recorded_;
    state.record = make_step_record(number, state.density, state.observation, spec_);
    if (number == 0) progress_.start_luminance = state.observation.map.luminance;
    Target(spec_, state.observation.map.luminance.grid).flatten(state.observation);
    return state;
  }

  bool records_wanted() const { return model_.recording && updater_->wants_records(); }

  /// The newest, and of the earlier ones those that fit.
  void keep_records(const Observation& observation, std::uint32_t step) {
    if (!observation.records) return;
    recorded_.push_back({observation.records, observation.luminance, observation.photons, step});
    const auto bytes = [&] {
      std::size_t sum = 0;
      for (const RecordedTrace& trace : recorded_) sum += trace.records->bytes();
      return sum;
    };
    while (recorded_.size() > 1 && bytes() > kMostRecordBytes) recorded_.erase(recorded_.begin());
    auto& told = progress_.memory[kRecordedSteps];
    told.clear();
    for (const RecordedTrace& trace : recorded_) {
      told.push_back(trace.step);
      told.push_back(static_cast<double>(trace.photons));
      const auto& density = trace.records->density().cells.values;
      told.insert(told.end(), density.begin(), density.end());
    }
  }

  /// Records are not in the checkpoint, but what they were traced with is: after an interruption they are traced again,
  /// to the same bits. False: interrupted.
  bool restore_records(std::uint32_t step) {
    const auto told = progress_.memory.find(kRecordedSteps);
    if (!recorded_.empty() || told == progress_.memory.end()) return true;
    const std::vector<double> list = told->second;
    tracer::DensityField density = progress_.density;
    const std::size_t cells = density.cells.values.size();
    for (std::size_t at = 0; at + 2 + cells <= list.size(); at += 2 + cells) {
      const auto number = static_cast<std::uint32_t>(list[at]);
      if (number >= step) break;
      const auto values = list.begin() + static_cast<std::ptrdiff_t>(at) + 2;
      std::copy(values, values + static_cast<std::ptrdiff_t>(cells), density.cells.values.begin());
      auto again = model_.recording(density, static_cast<std::uint64_t>(list[at + 1]), number);
      if (!again) return false;
      keep_records(*again, number);
    }
    return true;
  }

  std::optional<Foresight> foresight_of(const Proposal& proposal) const {
    if (!proposal.noise_left) return std::nullopt;
    const double reachable = proposal.solved ? proposal.foreseen_rms.value_or(0.0) : 0.0;
    return Foresight{*proposal.noise_left, std::max(spec_.stop_rms, reachable)};
  }

  void keep_best(const StepRecord& record, const tracer::DensityField& density) {
    const bool trusted = record.rms_corrected.se <= 0.5 * std::max(record.rms_corrected.value, spec_.stop_rms);
    const double value = record.rms_corrected.value;
    const double se = record.rms_corrected.se;
    const bool clearly_better = value + 2.0 * se < progress_.best_rms;
    const bool better = clearly_better || (trusted && value < progress_.best_rms + se) || reached(record, spec_);
    if (record.step > 0 && !better) return;
    progress_.best_rms = trusted || clearly_better ? std::max(value, 0.0) : kNoneYet;
    progress_.best_density = density;
  }

  void tell_limits(const Proposal& proposal) {
    progress_.limit_notes.clear();
    const double cells = static_cast<double>(proposal.density.cells.values.size());
    const auto tell = [&](int count, const char* limit, double value) {
      if (count == 0) return;
      progress_.limit_notes.push_back(fmt::format("The {} limit of the density ({}) holds {} cells ({:.2f} %).", limit,
                                                  value, count, 100.0 * count / cells));
    };
    tell(proposal.clipped_low, "lower", spec_.density_min);
    tell(proposal.clipped_high, "upper", spec_.density_max);
  }

  void scale_level(double factor, Proposal& proposal) const {
    for (double& density : proposal.density.cells.values) density *= factor;
    const CellLimits cells = cell_limits(spec_, proposal.density.cells.grid);
    proposal.density = within(cells, std::move(proposal.density));
    proposal.level_change *= factor;
  }

  /// Chooses the level once the shape is roughly right, and keeps the wanted efficiency later on. False: interrupted.
  bool settle_level(const DesignState& state, Proposal& proposal) {
    const StepRecord& record = state.record;
    if (spec_.level || !(record.luminance_mean > 0.0)) return true;
    if (!progress_.level_note.empty()) {
      keep_efficiency(record, proposal);
      return true;
    }
    if (std::min(record.rms_corrected.value, proposal.foreseen_rms.value_or(kNoneYet)) >= kRoughlyRight) return true;
    const auto choice = choose_level(model_, proposal.density, spec_,
                                     std::min(limits_.first_photons, limits_.largest_photons), limits_.largest_photons);
    if (!choice) return false;
    progress_.level_note = choice->note;
    progress_.level_slope = choice->slope;
    StepRecord& told = progress_.steps.back();
    told.level_photons = choice->photons;
    told.cpu_s += choice->cpu_s;
    told.wall_s += choice->wall_s;
    take_level(choice->factor, state, proposal);
    // A new level begins a new hunt for the best step.
    if (choice->factor != 1.0) progress_.best_rms = kNoneYet;
    return true;
  }

  /// The shape changes with the level. Histories tell how, as far as they know densities of that level.
  void take_level(double factor, const DesignState& state, Proposal& proposal) {
    if (state.recorded.empty() || factor == 1.0) {
      scale_level(factor, proposal);
      return;
    }
    DesignSpec there = spec_;
    there.level = std::clamp(factor * proposal.density.cells.mean(), spec_.density_min, spec_.density_max);
    const double cpu = core::process_cpu_seconds();
    proposal = updater_->propose(state, there, progress_.memory);
    progress_.steps.back().cpu_s += core::process_cpu_seconds() - cpu;
  }

  void keep_efficiency(const StepRecord& record, Proposal& proposal) const {
    if (spec_.goal.kind != "min_rms" || progress_.level_slope < kLeastSlope) return;
    const double lacking = std::log(spec_.goal.efficiency / record.efficiency.value);
    if (std::abs(lacking) < 2.0 * record.efficiency.se / record.efficiency.value) return;
    scale_level(std::clamp(std::exp(lacking / progress_.level_slope), 1.0 / kLevelStep, kLevelStep), proposal);
  }

  std::string stop_reason(const Proposal& proposal) const {
    const StepRecord& record = progress_.steps.back();
    const int patience = updater_->patience(spec_);
    if (reached(record, spec_) && level_rests(progress_, spec_, proposal)) {
      return fmt::format("reached: the noise-corrected RMS is {:.2f} +- {:.2f} % (wanted {:.2f} %)",
                         100.0 * record.rms_corrected.value, 100.0 * record.rms_corrected.se, 100.0 * spec_.stop_rms);
    }
    if (stalled(progress_.steps, limits_, patience)) {
      if (progress_.best_rms >= kNoneYet)
        return "stalled: the noise of the traces hides the RMS (more photons would tell)";
      return fmt::format("stalled: no better than {:.2f} % in the last {} steps", 100.0 * progress_.best_rms, patience);
    }
    if (record.step >= spec_.max_steps) return fmt::format("max_steps: {} steps were made", spec_.max_steps);
    return {};
  }

  const ForwardModel& model_;
  const DesignSpec& spec_;
  const DesignLimits& limits_;
  std::unique_ptr<const Updater> updater_;
  DesignProgress progress_;
  std::vector<RecordedTrace> recorded_;
};

}  // namespace

StepRecord make_step_record(int step, const tracer::DensityField& density, const Observation& observation,
                            const DesignSpec& spec) {
  const Evenness even = evenness(Target(spec, observation.map.luminance.grid).judged(observation.luminance));
  const core::Estimate mean = mean_of_cells(observation.luminance);
  StepRecord record;
  record.step = step;
  record.photons = observation.photons;
  record.rms = even.rms;
  record.rms_corrected = even.rms_corrected;
  record.noise =
      std::sqrt(std::max(0.0, even.rms * even.rms - even.rms_corrected.value * std::abs(even.rms_corrected.value)));
  record.efficiency = observation.efficiency;
  record.mean_density = density.cells.mean();
  record.luminance_mean = mean.value * observation.luminance_unit;
  record.cpu_s = observation.cpu_s;
  record.wall_s = observation.wall_s;
  return record;
}

FinalJudgment make_judgment(const Observation& observation, const DesignSpec& spec) {
  const Evenness even = evenness(Target(spec, observation.map.luminance.grid).judged(observation.luminance));
  const core::Estimate mean = mean_of_cells(observation.luminance);
  FinalJudgment judgment;
  judgment.photons = observation.photons;
  judgment.rms = even.rms;
  judgment.rms_corrected = even.rms_corrected;
  judgment.rms_low = even.low;
  judgment.rms_high = even.high;
  judgment.uniformity_9 = uniformity_9(observation.map.luminance);
  judgment.uniformity_13 = uniformity_13(observation.map.luminance);
  judgment.luminance_mean = {mean.value * observation.luminance_unit, mean.se * observation.luminance_unit};
  judgment.luminance_center = center_luminance(observation.map.luminance);
  if (mean.value > 0.0) {
    const SpotErrors errors = spot_errors(observation.luminance, observation.map.luminance.grid);
    judgment.uniformity_9_se = errors.uniformity_9;
    judgment.uniformity_13_se = errors.uniformity_13;
    judgment.luminance_center_se = errors.center * observation.luminance_unit;
  }
  judgment.efficiency = observation.efficiency;
  return judgment;
}

DesignProgress start_design(tracer::DensityField density, const DesignSpec& spec, const DesignLimits& limits) {
  DesignProgress progress;
  const CellLimits cells = cell_limits(spec, density.cells.grid);
  progress.density = within(cells, std::move(density));
  progress.best_density = progress.density;
  progress.photons = std::min(limits.first_photons, limits.largest_photons);
  return progress;
}

DesignProgress run_design(const ForwardModel& model, const DesignSpec& spec, const DesignLimits& limits,
                          DesignProgress progress, const StepObserver& observer) {
  Loop loop(model, spec, limits, std::move(progress));
  while (!loop.finished() && loop.step(observer)) {
  }
  return loop.take();
}

}  // namespace evenglow::design
