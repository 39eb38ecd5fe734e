#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/estimate.h"

/// What is measured of a finished design besides its luminance: color, viewing angles, LEDs that show.
namespace evenglow::design {

/// A color with its errors: CIE 1931 (x, y), CIE 1976 (u', v'), correlated color temperature.
struct ColorPoint {
  core::Estimate x, y;
  core::Estimate u, v;
  core::Estimate kelvin;
  core::Estimate distance;  ///< from the Planckian locus in CIE 1960 (u, v), > 0 above it
};

/// The color of a display. Distances are Euclidean in (u', v').
struct ColorJudgment {
  core::CellField u, v;             ///< of each cell; not a number where no light was seen
  core::CellField u_se, v_se;       ///< standard errors
  core::CellField delta;            ///< distance of each cell from the mean color, noise included
  core::CellField delta_se;         ///< along the way from the mean color to the cell's
  ColorPoint mean;                  ///< of all light of the active area
  ColorPoint emitted;               ///< of the light of the sources, exact
  core::Estimate shift;             ///< distance of `mean` from `emitted`
  double rms = 0.0;                 ///< root of the mean square of `delta`, noise included
  core::Estimate rms_corrected;     ///< without the noise; signed root, as that of `Evenness`
  core::Estimate max;               ///< greatest value of `delta`, noise included: too large where the noise is
  double max_x = 0.0, max_y = 0.0;  ///< where, mm
  core::Estimate max_corrected;     ///< found in one half of the batches and measured in the other; signed root
  std::size_t dark_cells = 0;       ///< cells without light, left out of all figures
};

/// Where the luminance in one plane through the normal has fallen to half its greatest value (half_angles.h).
struct HalfAngles {
  core::Estimate from_deg;   ///< on the side of negative angles
  core::Estimate to_deg;     ///< on the other
  core::Estimate width_deg;  ///< to - from
};

/// How much the LEDs of a row show at one distance from their edge.
struct HotSpotLine {
  double distance = 0.0;   ///< of the cells' centers from the edge of the plate, mm
  core::Estimate front;    ///< cd/m2, mean in front of the LEDs
  core::Estimate between;  ///< cd/m2, mean between them
  core::Estimate ratio;    ///< front over between
};

/// The LEDs of a row as seen from the front.
struct HotSpots {
  std::size_t source = 0;  ///< index in the list of sources
  std::string edge;
  int gaps = 0;            ///< between neighboring LEDs, all of whose cells the display shows
  double led_width = 0.0;  ///< mm, mean
  double gap_width = 0.0;  ///< mm, mean
  std::vector<HotSpotLine> lines;
  std::optional<double> mixing_distance;  ///< mm, beyond it the LEDs do not show; none: they do everywhere
};

}  // namespace evenglow::design
