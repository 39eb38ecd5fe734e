#include "design/engine/stop_rule.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "design/problem/pair_statistic.h"

namespace evenglow::design {
namespace {

constexpr double kStallGain = 0.05;
constexpr double kMostError = 0.5;  // of the squared RMS, over that to reach
constexpr double kSameLevel = 0.1;  // of the mean density
constexpr double kClearly = 2.0;    // standard errors
constexpr const char* kReached = "reached: ";

bool stalled(const DesignCourse& course, const DesignLimits& limits) {
  const std::vector<StepRecord>& steps = course.steps;
  if (static_cast<int>(steps.size()) < course.patience + 2) return false;
  const auto recent = steps.end() - course.patience;
  // More photons would help where noise may hide what is left.
  const StepRecord& first = *(recent - 1);
  if (first.photons < limits.largest_photons && first.rms_corrected.value < first.noise) return false;
  // Steps of another level, or whose square says less than its own error, are no measure.
  const double level = steps.back().mean_density;
  double before = kNoneYet;
  for (auto step = steps.begin(); step != recent; ++step) {
    const core::Estimate square = signed_square(step->rms_corrected);
    if (std::abs(step->mean_density - level) > kSameLevel * level || square.value < square.se) continue;
    before = std::min(before, square.value);
  }
  if (before >= kNoneYet) return false;
  const double gain = (1.0 - kStallGain) * (1.0 - kStallGain);
  return std::all_of(recent, steps.end(),
                     [&](const StepRecord& step) { return signed_square(step.rms_corrected).value > gain * before; });
}

std::string percent(const core::Estimate& rms) {
  return fmt::format("{:.2f} +- {:.2f} %", 100.0 * rms.value, 100.0 * rms.se);
}

}  // namespace

bool reached(const StepRecord& record, const DesignSpec& spec) {
  const core::Estimate square = signed_square(record.rms_corrected);
  const double bound = spec.stop_rms * spec.stop_rms;
  return square.value + square.se <= bound && square.se <= kMostError * bound;
}

bool shows_bound(const core::Estimate& rms, double bound) {
  const core::Estimate square = signed_square(rms);
  return square.value - square.se <= bound * bound && square.se <= bound * bound;
}

std::string stop_reason(const DesignCourse& course, const DesignSpec& spec, const DesignLimits& limits) {
  const StepRecord& record = course.steps.back();
  if (reached(record, spec) && course.level_rests) {
    return fmt::format("{}the noise-corrected RMS is {} (wanted {:.2f} %)", kReached, percent(record.rms_corrected),
                       100.0 * spec.stop_rms);
  }
  if (stalled(course, limits)) {
    if (course.best_rms >= kNoneYet) return "stalled: the noise of the traces hides the RMS (more photons would tell)";
    return fmt::format("stalled: no better than {:.2f} % in the last {} steps", 100.0 * course.best_rms,
                       course.patience);
  }
  if (record.step >= spec.max_steps) return fmt::format("max_steps: {} steps were made", spec.max_steps);
  return {};
}

std::string confirmed_goal(const std::string& reason, const FinalJudgment& judged, const GoalSpec& goal) {
  if (goal.kind != "min_rms") return reason;
  const core::Estimate& efficiency = judged.efficiency;
  if (efficiency.value + kClearly * efficiency.se >= goal.efficiency) return reason;
  return fmt::format("missed: the independent trace shows an efficiency of {} (wanted {:.2f} %); before it, {}",
                     percent(efficiency), 100.0 * goal.efficiency, reason);
}

std::string confirmed_reason(const std::string& reason, const FinalJudgment& judged, double bound) {
  const core::Estimate& rms = judged.rms_corrected;
  if (reason.rfind(kReached, 0) != 0 || !(rms.value > bound)) return reason;
  if (rms.value - kClearly * rms.se > bound) {
    return fmt::format("missed: the independent trace shows an RMS of {} (wanted {:.2f} %); before it, {}",
                       percent(rms), 100.0 * bound, reason.substr(std::string(kReached).size()));
  }
  return fmt::format("{}; the independent trace shows {}: above the bound, but within its error", reason, percent(rms));
}

}  // namespace evenglow::design
