#pragma once

#include <optional>
#include <string>

#include "core/montecarlo/estimate.h"
#include "design/problem/design_state.h"

/// Even color as a bound of a design.
namespace evenglow::design {

/// RMS distance of the colors of the cells from their mean in (u', v') with the noise taken off (color_merit.h); none
/// without a color receiver, or without light.
std::optional<core::Estimate> color_rms(const Observation& observation);

/// Within its error: value <= bound + standard error. Without a figure nothing is known to break the bound.
bool keeps_color(const std::optional<core::Estimate>& color, const std::optional<double>& bound);

/// What an independent trace says of the bound, one sentence.
std::string color_verdict(const core::Estimate& color, double bound);

}  // namespace evenglow::design
