#include "design/engine/dot_verification.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "design/dots/scaled_sizes.h"
#include "design/engine/design_loop.h"
#include "design/engine/stop_rule.h"
#include "design/problem/regrid.h"
#include "design/problem/target.h"
#include "design/updaters/log_step.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "tracer/microstructure/dot_grid.h"

namespace evenglow::design {
namespace {

constexpr double kGain = 0.05;        // a correction that gains less is the last one
constexpr double kReserve = 0.999;    // of what the placement holds
constexpr double kLeast = 1e-6;       // least density that a logarithm is taken of
constexpr double kMostScaling = 1.4;  // of a dot's area, in one pass
constexpr int kSizePasses = 6;        // dots over borders of cells and dots at limits leave something to the next

core::Estimate ratio_of(const core::Estimate& a, const core::Estimate& b) {
  if (!(a.value > 0.0 && b.value > 0.0)) return {0.0, 0.0};
  const double ratio = a.value / b.value;
  return {ratio, ratio * std::hypot(a.se / a.value, b.se / b.value)};
}

bool even_enough(const StepRecord& record, const DesignSpec& spec) {
  return record.rms_corrected.value <= spec.stop_rms + record.rms_corrected.se &&
         record.rms_corrected.se <= 0.5 * spec.stop_rms;
}

/// Dots of a density and what they show.
struct Trial {
  tracer::DensityField density;  ///< wanted
  Placement placement;
  core::CellField rounding;  ///< ln of the density placed over that wanted, of each cell
  Observation observation;
  DotsRound round;
};

class Verifier {
 public:
  Verifier(const DotVerification& job, const core::Estimate& model_luminance, const VerificationHooks& hooks)
      : job_(job), model_luminance_(model_luminance), hooks_(hooks) {}

  std::optional<VerifiedDots> run(tracer::DensityField density) {
    VerifiedDots result;
    DotsJudgment& judgment = result.judgment;
    double best = 0.0;
    for (int number = 0;; ++number) {
      auto trial = make(std::move(density), number);
      if (!trial) return std::nullopt;
      judgment.rounds.push_back(trial->round);
      hooks_.finished(trial->round);
      const StepRecord& record = trial->round.record;
      const double rms = std::max(record.rms_corrected.value, 0.0);
      const double before = best;
      if (number == 0 || rms < best) {
        best = rms;
        judgment.chosen = judgment.rounds.size() - 1;
        judgment.density = trial->density.cells;
        result.placement = trial->placement;
      }
      judgment.stop_reason = stop_reason(record, number, rms, before);
      if (!judgment.stop_reason.empty()) break;
      density = corrected(*trial);
    }
    hooks_.begins(-1);
    const auto seen = observe({judgment.density}, result.placement, kVerifiedStep);
    if (!seen) return std::nullopt;
    judgment.final = make_judgment(*seen, job_.spec);
    judgment.stop_reason = confirmed_reason(judgment.stop_reason, judgment.final, job_.spec.stop_rms);
    judgment.over_density = ratio_of(judgment.final.luminance_mean, model_luminance_);
    judgment.luminance = seen->map.luminance;
    judgment.luminance_se = seen->map.standard_error;
    judgment.energy = seen->energy;
    return result;
  }

 private:
  std::shared_ptr<const tracer::DotGrid> grid_of(const Placement& placement) const {
    const RectangleZone& face = job_.face;
    return std::make_shared<const tracer::DotGrid>(placement.dots, job_.dots.footprint,
                                                   tracer::FaceArea{face.x0, face.x1, face.y0, face.y1});
  }

  std::optional<Observation> observe(tracer::DensityField density, const Placement& placement, std::uint32_t step) {
    density.dots = grid_of(placement);
    return job_.model(density, job_.photons, step);
  }

  /// Places and traces the dots. Empty: interrupted.
  std::optional<Trial> make(tracer::DensityField density, int number) {
    hooks_.begins(number);
    Trial trial;
    trial.density = std::move(density);
    core::CellField coverage = trial.density.cells;
    for (double& value : coverage.values) value = std::min(1.0, value * job_.fill);
    const CoverageMap map(std::move(coverage), job_.free);
    if (seen_.empty() || job_.dots.mode == DotMode::spacing) {
      trial.placement = place_dots(job_.dots, map, job_.threads, job_.stop);
      if (job_.stop.stop_requested()) return std::nullopt;
      trial.rounding = rounding_of(trial.placement, map);
      first_ = trial.placement;
    } else {
      trial.placement = resized(map);
      trial.rounding = regrid(misfit(trial.placement, map, seen_.back().on_display.grid), map.grid());
    }
    auto seen = observe(trial.density, trial.placement, kVerifyingStep + static_cast<std::uint32_t>(number));
    if (!seen) return std::nullopt;
    trial.observation = std::move(*seen);
    DotsRound& round = trial.round;
    round.dots = trial.placement.dots.size();
    round.area = trial.placement.area;
    round.record = make_step_record(number, trial.density, trial.observation, job_.spec);
    round.luminance = make_judgment(trial.observation, job_.spec).luminance_mean;
    round.over_density = ratio_of(round.luminance, model_luminance_);
    return trial;
  }

  core::CellField rounding_of(const Placement& placement, const CoverageMap& map) const {
    return misfit(placement, map, map.grid());
  }

  /// ln of the share of each cell of `cells` under dots over that wanted.
  core::CellField misfit(const Placement& placement, const CoverageMap& map, const core::CellGrid& cells) const {
    core::CellField wanted = map.coverage();
    for (std::size_t i = 0; i < wanted.values.size(); ++i) wanted.values[i] *= map.free_share(i);
    wanted = regrid(wanted, cells);
    core::CellField placed = grid_of(placement)->coverage(cells);
    for (std::size_t i = 0; i < placed.values.size(); ++i) {
      const double want = wanted.values[i];
      placed.values[i] = want > kLeast ? std::log(std::max(placed.values[i], 0.1 * want) / want) : 0.0;
    }
    return placed;
  }

  /// The dots of the first round with the sizes that bring what each cell of the display shows under dots to the
  /// density wanted. The cells that were filled when the dots were placed are others, and in these a whole dot more or
  /// less stays; beyond the display it is these that are filled.
  Placement resized(const CoverageMap& map) const {
    Placement result = first_;
    const core::CellGrid& display = seen_.back().on_display.grid;
    const double most = std::log(kMostScaling);
    for (int pass = 0; pass < kSizePasses; ++pass) {
      const core::CellField shown = misfit(result, map, display), hidden = misfit(result, map, map.grid());
      const auto factor = [&](double x, double y) {
        const int cell = display.index_at(x, y);
        const double excess = cell >= 0 ? shown.values[static_cast<std::size_t>(cell)] : hidden.at(x, y);
        return std::exp(std::clamp(-excess, -most, most));
      };
      result.dots = scaled_sizes(job_.dots, job_.free, map.grid(), result.dots, factor, job_.threads);
    }
    result.wanted_area = map.wanted_in_all();
    result.area = 0.0;
    for (const core::Dot& dot : result.dots)
      result.area += core::footprint_area(job_.dots.footprint, 2.0 * static_cast<double>(dot.radius));
    return result;
  }

  std::string stop_reason(const StepRecord& record, int number, double rms, double before) const {
    if (even_enough(record, job_.spec)) {
      return fmt::format("reached: the noise-corrected RMS of the dots is {:.2f} +- {:.2f} % (wanted {:.2f} %)",
                         100.0 * record.rms_corrected.value, 100.0 * record.rms_corrected.se,
                         100.0 * job_.spec.stop_rms);
    }
    if (number > 0 && rms > (1.0 - kGain) * before)
      return fmt::format("no gain: the last correction brought the RMS from {:.2f} to {:.2f} %", 100.0 * before,
                         100.0 * rms);
    if (number >= job_.spec.verify_rounds) return fmt::format("verify_rounds: {} corrections were made", number);
    return {};
  }

  /// Takes the trial to the others: its luminance over target, and the density that gave it.
  void remember(const Trial& trial) {
    Observation seen = trial.observation;
    Target(job_.spec, seen.map.luminance.grid).flatten(seen);
    core::CellField placed = trial.density.cells;
    for (std::size_t i = 0; i < placed.values.size(); ++i) placed.values[i] *= std::exp(trial.rounding.values[i]);
    core::CellField on_display = regrid(placed, seen.map.luminance.grid);
    seen_.push_back({std::move(seen), std::move(on_display), std::move(placed)});
  }

  /// All traces so far as one of the last density: a cell's luminance follows its own density, near enough for the
  /// small steps between the rounds. So the noise falls from round to round.
  Observation all_traces() const {
    const Seen& last = seen_.back();
    Observation all = last.observation;
    all.luminance = core::Tally(last.on_display.values.size());
    const double share = 1.0 / static_cast<double>(seen_.size());
    std::vector<double> total(last.on_display.values.size(), 0.0);
    for (const Seen& one : seen_) {
      for (std::size_t b = 0; b < one.observation.luminance.batches(); ++b) {
        std::vector<double> batch = one.observation.luminance.batch(b);
        for (std::size_t i = 0; i < batch.size(); ++i) {
          batch[i] *= share * last.on_display.values[i] / std::max(one.on_display.values[i], kLeast);
          total[i] += batch[i];
        }
        all.luminance.add_batch(std::move(batch));
      }
    }
    for (std::size_t i = 0; i < total.size(); ++i) all.map.luminance.values[i] = total[i] * all.luminance_unit;
    return all;
  }

  /// The next density. What is smooth is the light that a unit of placed density sends out.
  tracer::DensityField corrected(const Trial& trial) {
    remember(trial);
    DesignState placed{{seen_.back().placed}, all_traces()};
    core::CellField excess = noise_aware_excess(placed).field;
    const core::CellField rounding = regrid(trial.rounding, excess.grid);
    for (std::size_t i = 0; i < excess.values.size(); ++i) excess.values[i] -= rounding.values[i];
    const double mean = excess.mean();
    for (double& value : excess.values) value -= mean;
    placed.density = trial.density;
    return take_step(placed, job_.spec, ratio_step(placed, job_.spec, excess)).density;
  }

  /// What a round has shown, over target.
  struct Seen {
    Observation observation;
    core::CellField on_display;  ///< density placed, on the cells of the display
    core::CellField placed;
  };

  const DotVerification& job_;
  core::Estimate model_luminance_;
  const VerificationHooks& hooks_;
  std::vector<Seen> seen_;
  Placement first_;  ///< of the first round
};

}  // namespace

double greatest_dot_density(const DotSpec& dots, double fill) {
  const double diameter = dots.mode == DotMode::spacing ? dots.diameter : dots.diameter_max;
  return std::min(1.0, kReserve * greatest_coverage(dots, diameter) / fill);
}

std::optional<VerifiedDots> verify_dots(const DotVerification& job, const tracer::DensityField& designed,
                                        const core::Estimate& model_luminance, const VerificationHooks& hooks) {
  return Verifier(job, model_luminance, hooks).run(designed);
}

}  // namespace evenglow::design
