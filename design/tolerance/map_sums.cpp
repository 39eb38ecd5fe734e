#include "design/tolerance/map_sums.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// Variance from the sums of n values, of their squares and of their squared errors; may be negative.
double variance_of(double sum, double squares, double noise, double n) {
  return (squares - sum * sum / n) / (n - 1.0) - noise / n;
}

core::CellField deviation(const core::CellField& variance, double smoothing) {
  core::CellField field = core::smooth_gaussian(variance, smoothing);
  for (double& value : field.values) value = std::sqrt(std::max(0.0, value));
  return field;
}

}  // namespace

void MapSums::add(const tracer::LuminanceMap& map) {
  const std::vector<double>& values = map.luminance.values;
  if (count_ == 0) {
    grid_ = map.luminance.grid;
    sums_.assign(kSums * values.size(), 0.0);
  }
  core::expects(map.luminance.grid == grid_, "all samples have the same cells");
  const double mean = map.luminance.mean(), cells = static_cast<double>(values.size());
  double of_mean = 0.0;  // variance of the noise of the mean
  for (const double se : map.standard_error.values) of_mean += se * se / (cells * cells);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = values[i], variance = map.standard_error.values[i] * map.standard_error.values[i];
    const double share = mean > 0.0 ? value / mean : 0.0;
    // To first order, the noise of the cells independent: that of the mean holds that of the cell.
    const double of_share =
        mean > 0.0 ? (variance * (1.0 - 2.0 * share / cells) + share * share * of_mean) / (mean * mean) : 0.0;
    const double terms[kSums] = {value, value * value, variance, share, share * share, of_share};
    for (std::size_t k = 0; k < kSums; ++k) sums_[kSums * i + k] += terms[k];
  }
  ++count_;
}

SpreadMaps MapSums::maps(bool common, double smoothing) const {
  core::expects(count_ >= 2, "a spread needs two samples");
  const auto n = static_cast<double>(count_);
  SpreadMaps maps{core::CellField(grid_, 0.0), core::CellField(grid_, 0.0), core::CellField(grid_, 0.0)};
  for (std::size_t i = 0; i < grid_.size(); ++i) {
    const double* s = &sums_[kSums * i];
    maps.mean.values[i] = s[0] / n;
    maps.deviation.values[i] = variance_of(s[0], s[1], common ? 0.0 : s[2], n);
    maps.shape.values[i] = variance_of(s[3], s[4], common ? 0.0 : s[5], n);
  }
  maps.deviation = deviation(maps.deviation, smoothing);
  maps.shape = deviation(maps.shape, smoothing);
  return maps;
}

std::vector<double> MapSums::numbers() const {
  return sums_;
}

bool MapSums::restore(const core::CellGrid& grid, std::uint64_t count, const std::vector<double>& numbers) {
  if (numbers.size() != kSums * grid.size()) return false;
  grid_ = grid;
  count_ = count;
  sums_ = numbers;
  return true;
}

}  // namespace evenglow::design
