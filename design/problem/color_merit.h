#pragma once

#include "core/math/cell_field.h"
#include "core/math/vec3.h"
#include "core/montecarlo/tally.h"
#include "design/problem/metrology.h"

/// How even the color of a display is, with the Monte Carlo noise taken off.
namespace evenglow::design {

/// Tallies of the tristimulus values of each cell, batch by batch, in one common unit.
struct TristimulusTallies {
  const core::Tally& x;
  const core::Tally& y;
  const core::Tally& z;
};

/// From at least 6 batches of each cell of `cells`; `emitted`: tristimulus values of the light of the sources.
///
/// Chromaticities are ratios of sums over all batches. Their errors are those of the ratio estimator (Cochran, Sampling
/// Techniques, 3rd ed., eq. 6.13): the gradient of u' (v', ...) at the sums, applied to the X, Y, Z of each batch,
/// gives a residual for each batch, and the error comes from the spread of these. So every correlation between X, Y and
/// Z, from cell to cell and with the mean color, is in it. The linearization asks for a few percent of noise in a cell.
///
/// The mean square of the distances is a mean over pairs of batches (pair_statistic.h) of the linearized distances.
ColorJudgment judge_color(const core::CellGrid& cells, const TristimulusTallies& tallies, const core::Vec3& emitted);

}  // namespace evenglow::design
