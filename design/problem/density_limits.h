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
/// counts. They are as symmetric as the density must be, and keep the ratio of neighbors themselves: a limit that does
/// not is tightened, so that a density which is moved into its limits keeps what it kept before.
CellLimits cell_limits(const DesignSpec& spec, const core::CellGrid& cells);

/// Every density moved into its limits.
tracer::DensityField within(const CellLimits& limits, tracer::DensityField density);

/// The factor on a shape that brings the mean of the scaled densities, each moved into its limits, to `mean`; to the
/// nearest mean that the limits allow, if they allow less or more.
double scale_to_mean(const core::CellField& shape, const CellLimits& limits, double mean);

/// Cells that a limit holds: at it, or beyond it where `scale` is on the density.
struct HeldCells {
  int low = 0, high = 0;
};
HeldCells held_cells(const CellLimits& limits, const core::CellField& density, double scale = 1.0);

/// Mirror images averaged (geometric mean) about the middle of the plate in x, in y, or both, as the spec asks.
void make_symmetric(const DesignSpec& spec, core::CellField& density);

/// Neighboring cells (along x and y) brought within the factor `ratio` of each other: the mean, in ln density, of the
/// greatest field below and of the least field above that keep it, |ln d_i - ln d_j| <= |i - j| ln ratio (inf- and
/// sup-convolution with a cone; both keep the bound, and so does their mean). Fields that keep it already stay as they
/// are.
void limit_neighbor_ratio(double ratio, core::CellField& density);

}  // namespace evenglow::design
