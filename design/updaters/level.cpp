#include "design/updaters/level.h"

#include <algorithm>

#include "design/problem/density_limits.h"

namespace evenglow::design {
namespace {

constexpr double kHeadroom = 0.97;  // the fullest cell, over its upper limit, once the level gives way
constexpr double kGiveWay = 0.8;    // the least factor of the level in a step

/// Of the densities to their upper limits, the greatest ratio. Cells that a map holds below the common limit (keep-out
/// zones) are left out: they would drag the level of all others down.
double fullest(const core::CellField& shape, const CellLimits& limits, double common) {
  double result = 0.0;
  for (std::size_t i = 0; i < shape.values.size(); ++i) {
    if (limits.largest.values[i] < common) continue;
    result = std::max(result, shape.values[i] / limits.largest.values[i]);
  }
  return result;
}

double scale_of(const core::CellField& shape, double current_mean, const DesignSpec& spec, const CellLimits& limits) {
  if (spec.level) return scale_to_mean(shape, limits, *spec.level);
  const double unchanged = current_mean / shape.mean();
  const double full = fullest(shape, limits, spec.density_max);
  if (unchanged * full <= 1.0) return scale_to_mean(shape, limits, current_mean);
  return std::max(kGiveWay * unchanged, kHeadroom / full);
}

}  // namespace

Proposal with_level(tracer::DensityField shape, double current_mean, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, shape.cells.grid);
  make_symmetric(spec, shape.cells);
  if (spec.neighbor_ratio) limit_neighbor_ratio(*spec.neighbor_ratio, shape.cells);
  const double scale = scale_of(shape.cells, current_mean, spec, limits);
  Proposal proposal;
  for (double& density : shape.cells.values) density *= scale;
  proposal.density = within(limits, std::move(shape));
  const HeldCells held = held_cells(limits, proposal.density.cells);
  proposal.clipped_low = held.low;
  proposal.clipped_high = held.high;
  proposal.level_change = proposal.density.cells.mean() / current_mean;
  return proposal;
}

}  // namespace evenglow::design
