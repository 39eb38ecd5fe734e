#pragma once

#include <array>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/estimate.h"
#include "core/montecarlo/tally.h"

namespace evenglow::design {

/// The uniformities (9 spots, 13 spots) of one trace as its even and its odd batches alone show them.
///
/// The least of noisy spots is too small and the greatest too large, so that noise lowers a uniformity; and where spots
/// are nearly alike, the noise of their least is smaller than that of any of them, which neither the jackknife nor
/// first-order errors see. Two independent halves of the trace tell both without a model (`noise_of_halves`).
struct HalfTraces {
  std::array<double, 2> nine{};
  std::array<double, 2> thirteen{};
};

/// At least 2 batches of the cells of `grid`, in its order.
HalfTraces half_traces(const core::Tally& luminance, const core::CellGrid& grid);

/// What the halves of many traces tell of a figure.
struct HalfNoise {
  std::vector<double> se;  ///< of each whole trace: half the difference of its halves, with one degree of freedom
  core::Estimate shift;    ///< by how much noise moves the whole traces on average
};

/// The squared difference of two halves is on average twice their variance, which is twice that of the whole trace. A
/// shift that grows as the noise is sqrt(2) as large for a half: (mean of the halves - whole) / (sqrt(2) - 1). Where
/// spots are well apart it grows faster, and this is too much by a part of it. At least 2 traces.
HalfNoise noise_of_halves(const std::vector<std::array<double, 2>>& halves, const std::vector<double>& wholes);

}  // namespace evenglow::design
