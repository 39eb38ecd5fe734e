#include "design/updaters/level.h"

#include <algorithm>

#include "design/problem/density_limits.h"

namespace evenglow::design {
namespace {

constexpr double kHeadroom = 0.97;  // the fullest cell, over its upper limit, once the level gives way
constexpr double kGiveWay = 0.8;    // the least factor of the level in a step

/// Of the densities to their upper limits, the greatest ratio.
double fullest(const core::CellField& shape, const CellLimits& limits) {
  double result = 0.0;
  for (std::size_t i = 0; i < shape.values.size(); ++i)
    result = std::max(result, shape.values[i] / limits.largest.values[i]);
  return result;
}

double scale_of(const core::CellField& shape, double current_mean, const DesignSpec& spec, const CellLimits& limits) {
  if (spec.level) return *spec.level / shape.mean();
  const double unchanged = current_mean / shape.mean();
  const double full = fullest(shape, limits);
  if (unchanged * full <= 1.0) return unchanged;
  return std::max(kGiveWay * unchanged, kHeadroom / full);
}

}  // namespace

Proposal with_level(tracer::DensityField shape, double current_mean, const DesignSpec& spec) {
  const CellLimits limits = cell_limits(spec, shape.cells.grid);
  make_symmetric(spec, shape.cells);
  if (spec.neighbor_ratio) limit_neighbor_ratio(*spec.neighbor_ratio, shape.cells);
  const double scale = scale_of(shape.cells, current_mean, spec, limits);
  Proposal proposal;
  for (std::size_t i = 0; i < shape.cells.values.size(); ++i) {
    double& density = shape.cells.values[i];
    density *= scale;
    if (density < limits.least.values[i]) ++proposal.clipped_low;
    if (density > limits.largest.values[i]) ++proposal.clipped_high;
  }
  proposal.density = within(limits, std::move(shape));
  proposal.level_change = proposal.density.cells.mean() / current_mean;
  return proposal;
}

}  // namespace evenglow::design
