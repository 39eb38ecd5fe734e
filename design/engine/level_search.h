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
  std::string note;     ///< what was tried and what came out, one sentence
};

/// The level of the density is free: evenness does not depend on it until a limit binds, and the efficiency grows with
/// it and saturates. Traces the shape at a few levels, and takes the lowest whose efficiency is within 2 % of the best:
/// a lower level couples the cells less and leaves more room to the limits. Levels that bring the largest density above
/// 3/4 of the upper limit are not tried: the shape grows steeper with the level. Empty: interrupted.
std::optional<LevelChoice> choose_level(const ForwardModel& model, const tracer::DensityField& density,
                                        const DesignSpec& spec, std::uint64_t photons);

}  // namespace evenglow::design
