#include "design/tolerance/half_traces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/base/error.h"
#include "design/problem/merit.h"

namespace evenglow::design {

HalfTraces half_traces(const core::Tally& luminance, const core::CellGrid& grid) {
  core::expects(luminance.batches() >= 2 && luminance.bins() == grid.size(), "two batches of the cells of the grid");
  HalfTraces result;
  for (std::size_t half = 0; half < 2; ++half) {
    core::CellField sum(grid, 0.0);
    for (std::size_t b = half; b < luminance.batches(); b += 2) {
      for (std::size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += luminance.batch(b)[i];
    }
    result.nine[half] = uniformity_9(sum);
    result.thirteen[half] = uniformity_13(sum);
  }
  return result;
}

HalfNoise noise_of_halves(const std::vector<std::array<double, 2>>& halves, const std::vector<double>& wholes) {
  core::expects(halves.size() >= 2 && halves.size() == wholes.size(), "the halves of two traces");
  HalfNoise noise;
  const auto n = static_cast<double>(halves.size());
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < halves.size(); ++i) {
    noise.se.push_back(0.5 * std::abs(halves[i][0] - halves[i][1]));
    const double moved = 0.5 * (halves[i][0] + halves[i][1]) - wholes[i];
    sum += moved;
    squares += moved * moved;
  }
  const double variance = std::max(0.0, (squares - sum * sum / n) / (n - 1.0));
  const double scale = 1.0 / (std::numbers::sqrt2 - 1.0);
  noise.shift = {scale * sum / n, scale * std::sqrt(variance / n)};
  return noise;
}

}  // namespace evenglow::design
