#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "design/engine/design_loop.h"
#include "design/problem/front_point.h"

/// Designs of one backlight at several levels of the density: efficiency against evenness.
namespace evenglow::design {

/// What the caller does beside the designs. All may be empty.
struct FrontHooks {
  /// A design of this point that was interrupted or has ended before; none: it begins.
  std::function<std::optional<DesignProgress>(int point)> load;
  std::function<void(int point, const StepRecord&, const DesignProgress&)> stepped;
  std::function<void(int point, const FrontPoint&)> finished;
};

/// What all points share.
struct FrontJob {
  const ForwardModel& model;
  DesignSpec spec;
  DesignLimits limits;
  tracer::DensityField start;  ///< of the first point; each further one starts from its neighbor, scaled
};

/// Levels for a front where the user names none: eight, from a quarter to five times the mean of the start, as far as
/// the limits allow.
std::vector<double> front_levels(const DesignSpec& spec, const tracer::DensityField& start);

/// A design at each level (rising), each judged by a trace with random numbers of its own: no point has seen those of
/// another, although it starts from its density. Empty: interrupted.
std::optional<std::vector<FrontPoint>> design_front(const FrontJob& job, const std::vector<double>& levels,
                                                    const FrontHooks& hooks);

/// All designs of a search for the highest efficiency, and the one that was chosen.
struct EfficiencySearch {
  std::vector<FrontPoint> points;
  std::size_t best = 0;
  bool feasible = false;  ///< whether the best keeps the bound
};

/// The goal max_efficiency: the level goes up by factors of 1.5 from the start as long as the RMS keeps its bound
/// (within one standard error) and the efficiency gains, down if it does not; then the last interval is halved twice in
/// ln level. With a bound of the color a point keeps its bounds if it keeps that as well; where the first one breaks
/// the color alone and nothing below keeps it, the search goes up. The efficiency alone hardly depends on the shape, so
/// one dimension is all there is. Empty: interrupted.
std::optional<EfficiencySearch> design_most_efficient(const FrontJob& job, double first_level, const FrontHooks& hooks);

}  // namespace evenglow::design
