#pragma once

#include "core/math/cell_field.h"
#include "design/problem/design_spec.h"
#include "tracer/scene/density_field.h"

/// What the maker of the plate allows.
namespace evenglow::design {

/// Least and largest density of each cell.
struct CellLimits {
  core::CellField least;
  core::CellField largest;
};

/// The limits of the spec on these cells: its two numbers, narrowed by its maps. Where the maps cross, the largest
/// counts.
CellLimits cell_limits(const DesignSpec& spec, const core::CellGrid& cells);

/// Every density moved into its limits.
tracer::DensityField within(const CellLimits& limits, tracer::DensityField density);

/// Mirror images averaged (geometric mean) about the middle of the plate in x, in y, or both, as the spec asks.
void make_symmetric(const DesignSpec& spec, core::CellField& density);

/// Neighboring cells (along x and y) brought within the factor `ratio` of each other: the mean, in ln density, of the
/// greatest field below and of the least field above that keep it, |ln d_i - ln d_j| <= |i - j| ln ratio (inf- and
/// sup-convolution with a cone; both keep the bound, and so does their mean). Fields that keep it already stay as they
/// are.
void limit_neighbor_ratio(double ratio, core::CellField& density);

}  // namespace evenglow::design
