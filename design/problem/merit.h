#pragma once

#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "design/problem/judgment.h"

/// How even a luminance map is, with the Monte Carlo noise taken off.
namespace evenglow::design {

/// RMS non-uniformity: standard deviation over mean of the cells. All but `mean` is not a number if no light was seen.
struct Evenness {
  double rms = 0.0;  ///< of the map as it is, noise included
  core::Estimate
      rms_corrected;  ///< without the noise; signed root, negative where noise alone explains more than is seen
  double low = 0.0;   ///< 95 % confidence interval of the RMS without noise: that of its square, which is normal; a
                      ///< square below 0 counts as 0 for the upper end, so that it is never empty
  double high = 0.0;
  core::Estimate mean;  ///< of the map, unit of the tally
};

/// From the batches of a luminance tally (at least 3).
///
/// With y_b the map of batch b over the overall mean, less its own spatial mean, and h(b, c) = <y_b, y_c> / cells, the
/// squared RMS without noise is the U-statistic C = mean of h over b != c: the noise of two batches is independent, so
/// nothing has to be subtracted (pair_statistic.h).
Evenness evenness(const core::Tally& luminance);

/// The mean of the cells with its standard error, unit of the tally.
core::Estimate mean_of_cells(const core::Tally& luminance);

/// The luminance with not-a-number where the target is 0: such cells do not count. An empty target: all count.
core::CellField counted_only(core::CellField luminance, const core::CellField& target);

/// Minimum over maximum of the luminance of spots at 9 points (a 3 x 3 grid at 10, 50 and 90 % of length and width) and
/// 13 points (those and the 4 at 30 and 70 %). A spot is the mean of the cells whose centers lie within 4 % of the
/// diagonal of the point; cells that are not a number do not count, nor spots of such cells. Not a number if all spots
/// are dark.
double uniformity_9(const core::CellField& luminance);
double uniformity_13(const core::CellField& luminance);
/// One of those spots.
struct SpotValue {
  double x = 0.0;  ///< mm
  double y = 0.0;  ///< mm
  double luminance = 0.0;
};
/// The 13 spots; the first 9 are those of `uniformity_9`.
std::vector<SpotValue> uniformity_spots(const core::CellField& luminance);
/// The mean of the spot at the center.
double center_luminance(const core::CellField& luminance);

/// Standard errors of the figures of the spots.
struct SpotErrors {
  double uniformity_9 = 0.0;
  double uniformity_13 = 0.0;
  double center = 0.0;  ///< unit of the tally
};
/// By the jackknife: each batch left out in turn (Efron, The Jackknife, the Bootstrap and Other Resampling Plans, 1982,
/// eq. 3.1). At least 2 batches of the cells of `target`, in its order; those of target 0 do not count.
SpotErrors spot_errors(const core::Tally& luminance, const core::CellField& target);

}  // namespace evenglow::design
