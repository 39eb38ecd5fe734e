#include "design/problem/color_merit.h"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "core/base/error.h"
#include "core/light/color.h"
#include "design/problem/chromaticity_batches.h"
#include "design/problem/pair_statistic.h"

namespace evenglow::design {
namespace {

using core::Vec2;
using core::Vec3;

std::vector<Vec3> batches_of(const TristimulusTallies& tallies, std::size_t cell) {
  std::vector<Vec3> batches;
  batches.reserve(tallies.y.batches());
  for (std::size_t b = 0; b < tallies.y.batches(); ++b) {
    batches.emplace_back(tallies.x.batch(b)[cell], tallies.y.batch(b)[cell], tallies.z.batch(b)[cell]);
  }
  return batches;
}

std::vector<Vec3> batches_of_all_cells(const TristimulusTallies& tallies) {
  std::vector<Vec3> batches(tallies.y.batches(), Vec3::Zero());
  for (std::size_t b = 0; b < batches.size(); ++b) {
    for (std::size_t cell = 0; cell < tallies.y.bins(); ++cell) {
      batches[b] += Vec3(tallies.x.batch(b)[cell], tallies.y.batch(b)[cell], tallies.z.batch(b)[cell]);
    }
  }
  return batches;
}

/// The way from the mean color to a cell's, as each batch sees it: the mean over the batches is the way itself.
std::vector<Vec2> ways_of(const ChromaticityBatches& cell, const ChromaticityBatches& mean) {
  const double count = static_cast<double>(cell.residuals.size());
  std::vector<Vec2> ways;
  ways.reserve(cell.residuals.size());
  for (std::size_t b = 0; b < cell.residuals.size(); ++b) {
    ways.emplace_back(cell.uv - mean.uv + count * (cell.residuals[b] - mean.residuals[b]));
  }
  return ways;
}

/// Length of the mean way and its error along itself; where it is nothing, that of a way of any direction.
core::Estimate length_of(const std::vector<Vec2>& ways) {
  Vec2 mean = Vec2::Zero();
  for (const Vec2& way : ways) mean += way / static_cast<double>(ways.size());
  const double length = mean.norm();
  const Vec2 along = length > 0.0 ? Vec2(mean / length) : Vec2(std::sqrt(0.5), std::sqrt(0.5));
  std::vector<double> residuals;
  residuals.reserve(ways.size());
  for (const Vec2& way : ways) residuals.push_back(along.dot(way - mean) / static_cast<double>(ways.size()));
  return {length, residual_se(residuals)};
}

void add_products(const std::vector<Vec2>& ways, BatchProducts& h) {
  for (std::size_t b = 0; b < ways.size(); ++b) {
    for (std::size_t c = 0; c < b; ++c) h.at(b, c) += ways[b].dot(ways[c]);
  }
}

/// The batches of one half: the even or the odd ones.
std::vector<Vec2> half_of(const std::vector<Vec2>& ways, std::size_t first) {
  std::vector<Vec2> half;
  for (std::size_t b = first; b < ways.size(); b += 2) half.push_back(ways[b]);
  return half;
}

/// Greatest distance, searched in one half of the batches and measured in the other, so that the noise that made it the
/// greatest is not in it.
class SplitMaximum {
 public:
  void add(const std::vector<Vec2>& ways) {
    for (std::size_t i = 0; i < 2; ++i) {
      const double found = length_of(half_of(ways, i)).value;
      if (found <= greatest_[i]) continue;
      greatest_[i] = found;
      const std::vector<Vec2> other = half_of(ways, 1 - i);
      BatchProducts h(other.size());
      add_products(other, h);
      square_[i] = pair_statistic(h);
    }
  }

  core::Estimate root() const {
    return signed_root(0.5 * (square_[0].value + square_[1].value), 0.5 * std::hypot(square_[0].se, square_[1].se));
  }

 private:
  double greatest_[2] = {-1.0, -1.0};
  core::Estimate square_[2];
};

ColorJudgment empty_judgment(const core::CellGrid& cells) {
  const core::CellField none(cells, std::numeric_limits<double>::quiet_NaN());
  ColorJudgment color;
  color.u = color.v = color.u_se = color.v_se = color.delta = color.delta_se = none;
  return color;
}

/// Fills the maps at one cell.
void put_cell(std::size_t i, const ChromaticityBatches& cell, const core::Estimate& delta, ColorJudgment& color) {
  const core::Estimate u = cell.u(), v = cell.v();
  color.u.values[i] = u.value;
  color.v.values[i] = v.value;
  color.u_se.values[i] = u.se;
  color.v_se.values[i] = v.se;
  color.delta.values[i] = delta.value;
  color.delta_se.values[i] = delta.se;
  if (delta.value <= color.max.value) return;
  const auto nx = static_cast<std::size_t>(color.u.grid.nx);
  color.max = delta;
  color.max_x = color.u.grid.center_x(static_cast<int>(i % nx));
  color.max_y = color.u.grid.center_y(static_cast<int>(i / nx));
}

}  // namespace

ColorJudgment judge_color(const core::CellGrid& cells, const TristimulusTallies& tallies, const Vec3& emitted) {
  const std::size_t batches = tallies.y.batches();
  core::expects(batches >= 6 && tallies.x.batches() == batches && tallies.z.batches() == batches,
                "at least 6 batches of X, Y and Z");
  core::expects(
      tallies.y.bins() == cells.size() && tallies.x.bins() == cells.size() && tallies.z.bins() == cells.size(),
      "X, Y and Z of each cell");
  ColorJudgment color = empty_judgment(cells);
  color.emitted = color_point({emitted});
  const std::vector<Vec3> all = batches_of_all_cells(tallies);
  const ChromaticityBatches mean = chromaticity_batches(all);
  if (mean.uv.y() <= 0.0) {
    color.dark_cells = cells.size();
    return color;
  }
  color.mean = color_point(all);
  color.shift = length_of(ways_of(mean, {core::chromaticity_uv(emitted), std::vector<Vec2>(batches, Vec2::Zero())}));

  BatchProducts h(batches);
  SplitMaximum maximum;
  double squares = 0.0, lit = 0.0;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const ChromaticityBatches cell = chromaticity_batches(batches_of(tallies, i));
    if (cell.uv.y() <= 0.0) {
      ++color.dark_cells;
      continue;
    }
    const std::vector<Vec2> ways = ways_of(cell, mean);
    const core::Estimate delta = length_of(ways);
    put_cell(i, cell, delta, color);
    add_products(ways, h);
    maximum.add(ways);
    squares += delta.value * delta.value;
    lit += 1.0;
  }
  color.rms = std::sqrt(squares / lit);
  for (std::size_t b = 0; b < batches; ++b) {
    for (std::size_t c = 0; c < b; ++c) h.at(b, c) /= lit;
  }
  const core::Estimate square = pair_statistic(h);
  color.rms_corrected = signed_root(square.value, square.se);
  color.max_corrected = maximum.root();
  return color;
}

}  // namespace evenglow::design
