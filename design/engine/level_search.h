#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"

namespace evenglow::design {

/// The level (mean density) that was chosen.
struct LevelChoice {
  double factor = 1.0;  ///< on the density that was handed in
  double log_se = 0.0;  ///< standard error of ln factor
  double slope = 0.0;   ///< d ln efficiency / d ln level there
  std::uint64_t photons = 0;
  double cpu_s = 0.0;
  double wall_s = 0.0;
  std::string note;  ///< what was tried and what came out, one sentence
};

/// The level of the density is free: evenness does not depend on it until a limit binds, and the efficiency grows with
/// it and saturates. The shape is traced at six levels with common random numbers; a saturating curve (level_fit.h) is
/// fitted to their efficiencies with the covariance of their batches, and the lowest level at which the *curve* is
/// within 2 % of its maximum is taken, continuously: a lower level couples the cells less and leaves more room to the
/// limits. With the goal min_rms it is the lowest level at which the curve reaches the wanted efficiency. Is its error
/// above 5 %, the levels are traced again with four times the photons (twice at most, with at most `most` photons).
///
/// Levels are tried within a factor of 3 of the given density, as far as no further cell comes to a limit: the fullest
/// cell stays below 3/4 of its upper limit (the shape grows steeper with the level), and no cell that is free comes
/// below its lower limit. Where what is looked for lies beyond that factor (and no limit is in the way), they are tried
/// again around the end of the range, up to three times: the choice does not hang on the start. Empty: interrupted.
std::optional<LevelChoice> choose_level(const ForwardModel& model, const tracer::DensityField& density,
                                        const DesignSpec& spec, std::uint64_t photons, std::uint64_t most);

}  // namespace evenglow::design
