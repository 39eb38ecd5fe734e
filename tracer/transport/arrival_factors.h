#pragma once

#include <vector>

#include "tracer/scene/density_field.h"

namespace evenglow::tracer {

/// Of each cell of the density: what the outcomes of an arrival traced at one density are worth at another, and how
/// that changes with the logarithm of the latter.
struct ArrivalFactors {
  std::vector<double> met, passed, slope_passed;

  /// Error if the two are of different cells.
  ArrivalFactors(const DensityField& traced, const DensityField& wanted);
};

}  // namespace evenglow::tracer
