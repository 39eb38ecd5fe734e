#include "design/engine/design_loop.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/core.h>

#include "core/montecarlo/batches.h"
#include "design/engine/kept_records.h"
#include "design/engine/level_search.h"
#include "design/engine/photon_plan.h"
#include "design/engine/stop_rule.h"
#include "design/problem/density_limits.h"
#include "design/problem/target.h"
#include "design/updaters/level.h"

namespace evenglow::design {
namespace {

constexpr double kSettledLevel = 0.05;
constexpr double kRoughlyRight = 0.3;  // RMS below which the level is chosen
constexpr double kLevelStep = 1.25;    // largest factor of a correction of the level
constexpr double kLevelMissed = 1e-3;
constexpr double kLeastSlope = 0.05;  // below it the efficiency does not hear the level

bool level_rests(const DesignProgress& progress, const DesignSpec& spec, const Proposal& proposal) {
  if (spec.level) return true;
  return !progress.level_note.empty() && std::abs(std::log(proposal.level_change)) < kSettledLevel;
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
    const HeldCells held = held_cells(cell_limits(spec_, state->density.cells.grid), state->density.cells);
    record.held_low = held.low;
    record.held_high = held.high;
    progress_.steps.push_back(record);
    keep_best(record, state->density);
    if (!settle_level(*state, proposal)) {
      progress_ = std::move(before);
      return false;
    }
    if (!proposal.note.empty()) progress_.notes.push_back(fmt::format("Step {}: {}", record.step, proposal.note));
    tell_limits();
    progress_.stop_reason = stop_reason(
        {progress_.steps, progress_.best_rms, updater_->patience(spec_), level_rests(progress_, spec_, proposal)},
        spec_, limits_);
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
    if (records_wanted() && !records_.restore(model_, progress_.density, step, progress_.memory)) return std::nullopt;
    auto observation = records_wanted() ? model_.recording(progress_.density, progress_.photons, step)
                                        : model_(progress_.density, progress_.photons, step);
    if (!observation) return std::nullopt;
    records_.keep(progress_.density, *observation, step, progress_.memory);
    DesignState state{progress_.density, std::move(*observation)};
    state.recorded = records_.traces();
    state.record = make_step_record(number, state.density, state.observation, spec_);
    if (number == 0) progress_.start_luminance = state.observation.map.luminance;
    Target(spec_, state.observation.map.luminance.grid).flatten(state.observation);
    return state;
  }

  bool records_wanted() const { return model_.recording && updater_->wants_records(); }

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

  /// Of the best density so far.
  void tell_limits() {
    progress_.limit_notes.clear();
    const core::CellField& density = progress_.best_density.cells;
    const CellLimits limits = cell_limits(spec_, density.grid);
    const auto tell = [&](int count, const char* limit, double value, const core::CellField& of_cells) {
      if (count == 0) return;
      const bool one = of_cells.max() - of_cells.min() <= 0.0;
      progress_.limit_notes.push_back(fmt::format(
          "The {} limit of the density ({}) holds {} cells ({:.2f} %).", limit,
          one ? fmt::format("{}", value) : fmt::format("{} to {}, cell by cell", of_cells.min(), of_cells.max()), count,
          100.0 * count / static_cast<double>(density.values.size())));
    };
    const HeldCells held = held_cells(limits, density);
    tell(held.low, "lower", spec_.density_min, limits.least);
    tell(held.high, "upper", spec_.density_max, limits.largest);
    if (spec_.level && std::abs(std::log(density.mean() / *spec_.level)) > kLevelMissed) {
      progress_.limit_notes.push_back(fmt::format(
          "The limits of the cells keep the level at {:.4f}; {:.4f} was asked for.", density.mean(), *spec_.level));
    }
  }

  void scale_level(double factor, Proposal& proposal) const {
    const CellLimits cells = cell_limits(spec_, proposal.density.cells.grid);
    const double before = proposal.density.cells.mean();
    const double scale = scale_to_mean(proposal.density.cells, cells, factor * before);
    for (double& density : proposal.density.cells.values) density *= scale;
    proposal.density = within(cells, std::move(proposal.density));
    proposal.level_change *= proposal.density.cells.mean() / before;
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

  const ForwardModel& model_;
  const DesignSpec& spec_;
  const DesignLimits& limits_;
  std::unique_ptr<const Updater> updater_;
  DesignProgress progress_;
  KeptRecords records_;
};

}  // namespace

DesignProgress start_design(tracer::DensityField density, const DesignSpec& spec, const DesignLimits& limits) {
  DesignProgress progress;
  const CellLimits cells = cell_limits(spec, density.cells.grid);
  density = within(cells, std::move(density));
  const double mean = density.cells.mean();
  progress.density = with_level(std::move(density), mean, spec).density;
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
