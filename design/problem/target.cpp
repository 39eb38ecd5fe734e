#include "design/problem/target.h"

#include <algorithm>
#include <deque>
#include <limits>

#include "core/base/error.h"
#include "core/math/cell_index.h"

namespace evenglow::design {
namespace {

constexpr double kCountsFrom = 1e-6;  // of the largest target: black cells of a picture are left out

/// Index of the nearest cell that counts, by a flood from all of them at once (in steps along the axes).
std::vector<std::size_t> nearest_of(const core::CellGrid& grid, const std::vector<std::size_t>& counted) {
  constexpr std::size_t kNone = std::numeric_limits<std::size_t>::max();
  std::vector<std::size_t> nearest(grid.size(), kNone);
  std::deque<std::size_t> front;
  for (const std::size_t i : counted) {
    nearest[i] = i;
    front.push_back(i);
  }
  const auto nx = static_cast<std::size_t>(grid.nx);
  while (!front.empty()) {
    const std::size_t i = front.front();
    front.pop_front();
    const auto reach = [&](bool inside, std::size_t j) {
      if (!inside || nearest[j] != kNone) return;
      nearest[j] = nearest[i];
      front.push_back(j);
    };
    reach(i % nx > 0, i - 1);
    reach(i % nx + 1 < nx, i + 1);
    reach(i >= nx, i - nx);
    reach(i + nx < grid.size(), i + nx);
  }
  return nearest;
}

}  // namespace

core::CellField target_shape(const TargetSpec& spec, const core::CellGrid& display) {
  if (!spec.map.empty()) return spec.map.over(display);
  core::CellField shape(display, 1.0);
  if (spec.kind != "center_weighted") return shape;
  for (int iy = 0; iy < display.ny; ++iy) {
    for (int ix = 0; ix < display.nx; ++ix) {
      // From -1 at the outer edge of the first cell to 1 at that of the last.
      const double u = (2.0 * ix + 1.0) / display.nx - 1.0;
      const double v = (2.0 * iy + 1.0) / display.ny - 1.0;
      shape.values[core::cell_index(display.nx, ix, iy)] = 1.0 - (1.0 - spec.corner) * 0.5 * (u * u + v * v);
    }
  }
  return shape;
}

std::vector<std::size_t> counted_cells(const DesignSpec& spec, const core::CellField& shape) {
  const core::CellField mask = spec.mask.empty() ? core::CellField(shape.grid, 1.0) : spec.mask.over(shape.grid);
  const double largest = shape.max();
  std::vector<std::size_t> counted;
  for (std::size_t i = 0; i < mask.values.size(); ++i) {
    if (mask.values[i] >= 0.5 && shape.values[i] > kCountsFrom * largest) counted.push_back(i);
  }
  return counted;
}

Target::Target(const DesignSpec& spec, const core::CellGrid& display)
    : relative_(display, 0.0), counted_(counted_cells(spec, target_shape(spec.target, display))) {
  const core::CellField shape = target_shape(spec.target, display);
  double sum = 0.0;
  for (const std::size_t i : counted_) {
    relative_.values[i] = shape.values[i];
    sum += shape.values[i];
  }
  core::expects(!counted_.empty(), "a target or mask leaves at least one cell of the display");
  for (double& value : relative_.values) value *= static_cast<double>(counted_.size()) / sum;
  plain_ = counted_.size() == display.size() && relative_.max() - relative_.min() < 1e-12;
  if (!plain_) nearest_ = nearest_of(display, counted_);
}

double Target::share_counted() const {
  return static_cast<double>(counted_.size()) / static_cast<double>(relative_.values.size());
}

core::Tally Target::judged(const core::Tally& luminance) const {
  if (plain_) return luminance;
  core::Tally result(counted_.size());
  for (std::size_t b = 0; b < luminance.batches(); ++b) {
    std::vector<double> sums;
    sums.reserve(counted_.size());
    for (const std::size_t i : counted_) sums.push_back(luminance.batch(b)[i] / relative_.values[i]);
    result.add_batch(std::move(sums));
  }
  return result;
}

void Target::flatten(std::vector<double>& values) const {
  for (const std::size_t i : counted_) values[i] /= relative_.values[i];
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = values[nearest_[i]];
}

void Target::flatten(Observation& observation) const {
  if (plain_) return;
  flatten(observation.map.luminance.values);
  core::Tally batches(observation.luminance.bins());
  for (std::size_t b = 0; b < observation.luminance.batches(); ++b) {
    std::vector<double> sums = observation.luminance.batch(b);
    flatten(sums);
    batches.add_batch(std::move(sums));
  }
  observation.luminance = std::move(batches);
}

}  // namespace evenglow::design
