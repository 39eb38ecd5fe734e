#pragma once

#include "core/math/cell_field.h"
#include "design/updaters/updater.h"

/// Steps in ln density, which all updaters of the ratio family share.
namespace evenglow::design {

/// ln(luminance / mean luminance) of each cell of the display. A cell that no light reached yet has ln 1e-6.
core::CellField log_excess(const DesignState& state);

/// The step of the ratio update on the cells of the density: -power x excess held in [ln 1/4, ln 4]; cells outside the
/// active area follow the nearest inside.
core::CellField ratio_step(const DesignState& state, const DesignSpec& spec, const core::CellField& excess);

/// The density times exp(step), at its level and within its limits. No cell changes by more than a factor of 4.
Proposal take_step(const DesignState& state, const DesignSpec& spec, const core::CellField& step);

}  // namespace evenglow::design
