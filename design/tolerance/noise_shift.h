#pragma once

#include <cstdint>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/estimate.h"
#include "core/montecarlo/tally.h"

namespace evenglow::design {

/// By how much the noise of a trace of `photons` moves each of `kFigures` on average. The least of noisy spots is too
/// small and the greatest too large, so that the uniformities come out too low; the others are moved by nothing that
/// counts, and get 0. Found in a long trace of `all_photons`: its batches in groups of about as many photons, the mean
/// figure of the groups less that of the whole trace, scaled by the root of the photons where the groups have not
/// exactly as many. Not a number where the long trace has not four groups.
std::vector<core::Estimate> noise_shift(const core::Tally& luminance, const core::CellGrid& grid,
                                        std::uint64_t all_photons, std::uint64_t photons);

}  // namespace evenglow::design
