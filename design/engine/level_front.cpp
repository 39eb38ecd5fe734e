#include "design/engine/level_front.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "design/engine/stop_rule.h"
#include "design/engine/traced_model.h"
#include "design/problem/color_bound.h"
#include "design/problem/density_limits.h"

namespace evenglow::design {
namespace {

constexpr int kPoints = 8;
constexpr double kDown = 0.25;   // of the start's mean
constexpr double kUp = 5.0;      // of it
constexpr double kRoom = 0.6;    // of the upper limit
constexpr double kFloor = 1.3;   // of the lower limit
constexpr double kFactor = 1.5;  // of the level from point to point of a search
constexpr int kMostPoints = 10;  // of a search
constexpr int kHalvings = 2;
constexpr std::uint32_t kStride = 4096;  // steps of random numbers that a point may use

/// Steps of point `point` get random numbers of their own; judging traces count down from the judging step.
ForwardModel own_numbers(const ForwardModel& model, int point) {
  const auto renumbered = [point](const auto& traced) {
    return [&traced, point](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
      const auto number = static_cast<std::uint32_t>(point);
      return traced(density, photons, step == kJudgingStep ? kJudgingStep - number : step + number * kStride);
    };
  };
  ForwardModel own = renumbered(model);
  if (model.recording) own.recording = renumbered(model.recording);
  return own;
}

tracer::DensityField at_level(tracer::DensityField density, double level, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, density.cells.grid);
  const double scale = scale_to_mean(density.cells, limits, level);
  for (double& value : density.cells.values) value *= scale;
  return within(limits, std::move(density));
}

std::optional<FrontPoint> design_point(const FrontJob& job, int number, double level, const tracer::DensityField& start,
                                       const FrontHooks& hooks) {
  const ForwardModel model = own_numbers(job.model, number);
  DesignSpec spec = job.spec;
  spec.goal = {};
  spec.level = level;
  auto progress = hooks.load ? hooks.load(number) : std::nullopt;
  if (!progress) progress = start_design(at_level(start, level, spec), spec, job.limits);
  const auto observer = [&](const StepRecord& record, const DesignProgress& state) {
    if (hooks.stepped) hooks.stepped(number, record, state);
  };
  progress = run_design(model, spec, job.limits, std::move(*progress), observer);
  if (progress->stop_reason.empty()) return std::nullopt;
  const auto judging = model(progress->best_density, job.limits.largest_photons, kJudgingStep);
  if (!judging) return std::nullopt;
  FrontPoint point;
  point.level = level;
  point.judged = make_judgment(*judging, spec);
  point.color = color_rms(*judging);
  point.breaks_color = !keeps_color(point.color, job.spec.goal.color);
  point.density = progress->best_density.cells;
  point.luminance = judging->map.luminance;
  point.stop_reason = confirmed_reason(progress->stop_reason, point.judged, spec.stop_rms);
  point.steps = static_cast<int>(progress->steps.size());
  const HeldCells held = held_cells(cell_limits(spec, point.density.grid), point.density);
  point.held_low = held.low;
  point.held_high = held.high;
  point.photons = judging->photons;
  point.cpu_s = judging->cpu_s;
  for (const StepRecord& step : progress->steps) {
    point.photons += step.photons + step.level_photons;
    point.cpu_s += step.cpu_s;
  }
  if (hooks.finished) hooks.finished(number, point);
  return point;
}

bool keeps_rms(const FrontPoint& point, double rms) {
  return shows_bound(point.judged.rms_corrected, rms);
}

bool keeps(const FrontPoint& point, double rms) {
  return keeps_rms(point, rms) && !point.breaks_color;
}

/// A search for the highest efficiency, point by point.
class Climb {
 public:
  Climb(const FrontJob& job, const FrontHooks& hooks) : job_(job), hooks_(hooks) {}

  /// False: interrupted.
  bool add(double level) {
    const tracer::DensityField start = found_.points.empty() ? job_.start : nearest(level);
    auto point = design_point(job_, static_cast<int>(found_.points.size()), level, start, hooks_);
    if (point) found_.points.push_back(std::move(*point));
    return point.has_value();
  }
  const FrontPoint& last() const { return found_.points.back(); }
  bool last_keeps() const { return keeps(last(), job_.spec.goal.rms); }
  /// Is the color all that the first point lacks?
  bool only_color_is_broken() const {
    return found_.points.front().breaks_color && keeps_rms(found_.points.front(), job_.spec.goal.rms);
  }
  bool full() const { return found_.points.size() >= kMostPoints; }

  EfficiencySearch take() {
    for (std::size_t i = 0; i < found_.points.size(); ++i) {
      const bool kept = keeps(found_.points[i], job_.spec.goal.rms);
      const bool first = i == 0 || (kept && !found_.feasible);
      if (!first && kept != found_.feasible) continue;
      const FrontJudgment a = of(found_.points[i]);
      const FrontJudgment b = of(found_.points[found_.best]);
      if (first || (kept ? a.efficiency > b.efficiency : a.rms < b.rms)) found_.best = i;
      found_.feasible = kept;
    }
    return std::move(found_);
  }

 private:
  struct FrontJudgment {
    double rms, efficiency;
  };
  static FrontJudgment of(const FrontPoint& point) {
    return {point.judged.rms_corrected.value, point.judged.efficiency.value};
  }
  tracer::DensityField nearest(double level) const {
    const auto distance = [&](const FrontPoint& point) { return std::abs(std::log(point.level / level)); };
    const auto best =
        std::min_element(found_.points.begin(), found_.points.end(),
                         [&](const FrontPoint& a, const FrontPoint& b) { return distance(a) < distance(b); });
    return {best->density};
  }

  const FrontJob& job_;
  const FrontHooks& hooks_;
  EfficiencySearch found_;
};

struct Bracket {
  double kept = 0.0;    ///< highest level known to keep the bound
  double broken = 0.0;  ///< lowest level known to break it or to gain nothing; 0: none
};

/// On by `factor` until a point keeps the bounds or the room ends. False: interrupted.
bool go(Climb& climb, double level, double factor, double low, double high, Bracket& bracket) {
  bool kept = false;
  while (!climb.full() && !kept && (factor < 1.0 ? level > low : level < high)) {
    bracket.broken = level;
    level = std::clamp(level * factor, low, high);
    if (!climb.add(level)) return false;
    kept = climb.last_keeps();
  }
  bracket.kept = kept ? level : 0.0;
  return true;
}

/// Up or down from the first point until the answer changes. Empty: interrupted.
std::optional<Bracket> find_bracket(Climb& climb, double level, double low, double high) {
  if (!climb.add(level)) return std::nullopt;
  Bracket bracket;
  if (!climb.last_keeps()) {
    const double first = level;
    if (!go(climb, level, 1.0 / kFactor, low, high, bracket)) return std::nullopt;
    // How the color follows the level is not known beforehand.
    level = first;
    if (bracket.kept == 0.0 && climb.only_color_is_broken() && !go(climb, level, kFactor, low, high, bracket))
      return std::nullopt;
    return bracket;
  }
  core::Estimate before;
  while (!climb.full()) {
    const core::Estimate now = climb.last().judged.efficiency;
    const bool gains = now.value > before.value + 2.0 * std::hypot(now.se, before.se);
    if (!climb.last_keeps() || !gains) {
      bracket.broken = level;
      return bracket;
    }
    bracket.kept = level;
    before = now;
    if (level >= high) return bracket;
    level = std::min(high, level * kFactor);
    if (!climb.add(level)) return std::nullopt;
  }
  return bracket;
}

}  // namespace

std::vector<double> front_levels(const DesignSpec& spec, const tracer::DensityField& start) {
  const double middle = start.cells.mean();
  const double low = std::max(kDown * middle, kFloor * spec.density_min);
  const double high = std::max(std::min(kUp * middle, kRoom * spec.density_max), 1.5 * low);
  std::vector<double> levels;
  levels.reserve(kPoints);
  for (int i = 0; i < kPoints; ++i)
    levels.push_back(low * std::pow(high / low, static_cast<double>(i) / (kPoints - 1)));
  return levels;
}

std::optional<std::vector<FrontPoint>> design_front(const FrontJob& job, const std::vector<double>& levels,
                                                    const FrontHooks& hooks) {
  std::vector<FrontPoint> points;
  tracer::DensityField start = job.start;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    auto point = design_point(job, static_cast<int>(i), levels[i], start, hooks);
    if (!point) return std::nullopt;
    start.cells = point->density;
    points.push_back(std::move(*point));
  }
  return points;
}

std::optional<EfficiencySearch> design_most_efficient(const FrontJob& job, double first_level,
                                                      const FrontHooks& hooks) {
  const double low = kFloor * job.spec.density_min;
  const double high = std::max(kRoom * job.spec.density_max, 1.01 * low);
  Climb climb(job, hooks);
  auto bracket = find_bracket(climb, std::clamp(first_level, low, high), low, high);
  if (!bracket) return std::nullopt;
  for (int i = 0; i < kHalvings && !climb.full() && bracket->kept > 0.0 && bracket->broken > 0.0; ++i) {
    const double level = std::sqrt(bracket->kept * bracket->broken);
    if (!climb.add(level)) return std::nullopt;
    (climb.last_keeps() ? bracket->kept : bracket->broken) = level;
  }
  return climb.take();
}

}  // namespace evenglow::design
