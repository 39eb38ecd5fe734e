#include "design/engine/stop_rule.h"

#include <algorithm>

#include <fmt/core.h>

#include "design/problem/pair_statistic.h"

namespace evenglow::design {
namespace {

constexpr double kStallGain = 0.05;
constexpr double kMostError = 0.5;  // of the squared RMS, over that to reach
constexpr double kClearly = 2.0;    // standard errors
constexpr const char* kReached = "reached: ";

bool stalled(const DesignCourse& course, const DesignLimits& limits) {
  const std::vector<StepRecord>& steps = course.steps;
  if (static_cast<int>(steps.size()) < course.patience + 2) return false;
  const auto recent = steps.end() - course.patience;
  // More photons would help where noise may hide what is left.
  const StepRecord& first = *(recent - 1);
  if (first.photons < limits.largest_photons && first.rms_corrected.value < first.noise) return false;
  const auto less = [](const StepRecord& a, const StepRecord& b) {
    return a.rms_corrected.value < b.rms_corrected.value;
  };
  const double before = std::min_element(steps.begin(), recent, less)->rms_corrected.value;
  return std::min_element(recent, steps.end(), less)->rms_corrected.value > (1.0 - kStallGain) * before;
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
