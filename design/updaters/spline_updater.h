#pragma once

#include "core/math/cell_field.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

/// A smooth profile with few coefficients, searched without derivatives: ln density = that of the start + a tensor
/// product of B-splines (cubic, or of the degree that the coefficients allow), the noise-corrected RMS handed to
/// NLopt's BOBYQA (Powell, DAMTP 2009/NA06), COBYLA (Powell 1994) or Sbplx (Rowan 1990). For plates whose pattern is
/// given by a formula, and as the yardstick of what generic optimizers reach.
///
/// NLopt asks for values; a design gives one each step. So the search is run anew each step on the values known so far
/// (it is deterministic), up to the first point that is not known: that is proposed.
std::unique_ptr<const Updater> make_spline_updater();

/// Value at each cell of the spline with nx x ny coefficients (index j * nx + i) over the rectangle of the grid.
core::CellField spline_field(const core::CellGrid& grid, int nx, int ny, const std::vector<double>& coefficients);

}  // namespace evenglow::design
