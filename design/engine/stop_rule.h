#pragma once

#include <string>
#include <vector>

#include "design/engine/photon_plan.h"
#include "design/problem/design_spec.h"
#include "design/problem/judgment.h"

/// When a design ends: one rule for all updaters.
namespace evenglow::design {

inline constexpr double kNoneYet = 1e9;  ///< best RMS so far where there is none: worse than any

/// Does the step show that the bound is kept? The squared RMS with the noise taken off (which is normal, and whose
/// trace the density has not seen) + its standard error <= `stop_rms`^2, and that error <= half of `stop_rms`^2. So a
/// density whose RMS is at the bound passes with a chance of 16 %, one of 1.2 times the bound with 3 % at most, and
/// with less the smaller the error is.
bool reached(const StepRecord& record, const DesignSpec& spec);

/// Does a judgment show that a bound of the RMS is kept within a standard error? Its square must be known to the square
/// of the bound: noise that hides the RMS is no evenness.
bool shows_bound(const core::Estimate& rms, double bound);

/// What the rule looks at beside the spec.
struct DesignCourse {
  const std::vector<StepRecord>& steps;
  double best_rms;   ///< so far, noise-corrected; kNoneYet: none that can be trusted
  int patience;      ///< of the updater
  bool level_rests;  ///< the mean density is the wanted one
};

/// One sentence, or nothing as long as the design goes on. It ends, in this order,
///
/// 1. reached, and the level rests;
/// 2. stalled: the steps of the patience brought no gain of 5 % over the earlier ones of that level whose RMS can be
/// told
///    from noise, at the largest number of photons or with less noise in a cell than RMS;
/// 3. after `max_steps`.
std::string stop_reason(const DesignCourse& course, const DesignSpec& spec, const DesignLimits& limits);

/// The reason after the independent trace has judged the design. Of a bound that was reached it tells when that trace
/// shows an RMS above it: by more than two standard errors (the bound is then missed), or within them.
std::string confirmed_reason(const std::string& reason, const FinalJudgment& judged, double bound);

/// The same of the efficiency that the goal min_rms must keep: told where it is missed by more than two standard
/// errors.
std::string confirmed_goal(const std::string& reason, const FinalJudgment& judged, const GoalSpec& goal);

}  // namespace evenglow::design
