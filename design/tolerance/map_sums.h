#pragma once

#include <cstdint>
#include <vector>

#include "core/math/cell_field.h"
#include "tracer/receivers/luminance_receiver.h"

namespace evenglow::design {

/// Mean and spread of the luminance of each cell over the samples.
struct SpreadMaps {
  core::CellField mean;  ///< cd/m2
  core::CellField
      deviation;          ///< cd/m2, of the population: the Monte Carlo variance of the samples taken off; at least 0
  core::CellField shape;  ///< share of 1: deviation of the luminance over the sample's own mean, noise taken off
};

/// Running sums over the samples, in their order.
class MapSums {
 public:
  /// `map`: luminance with standard errors of a sample, always of the same cells.
  void add(const tracer::LuminanceMap& map);
  std::uint64_t count() const { return count_; }
  /// With at least 2 samples. `common`: their noise is common, nothing is taken off. `smoothing`: the variances are
  /// smoothed by a Gaussian of so many cells before their root is taken, as those of single cells are mostly chance.
  SpreadMaps maps(bool common, double smoothing = 0.0) const;

  /// All sums one after another, for a checkpoint, and back (none taken if their number does not fit the cells).
  std::vector<double> numbers() const;
  bool restore(const core::CellGrid& grid, std::uint64_t count, const std::vector<double>& numbers);

 private:
  static constexpr std::size_t kSums = 6;
  core::CellGrid grid_;
  std::uint64_t count_ = 0;
  std::vector<double> sums_;  // value, its square, its noise; the same of the shape; cell by cell
};

}  // namespace evenglow::design
