#pragma once

#include <cstddef>
#include <optional>
#include <vector>

#include "core/montecarlo/tally.h"
#include "design/problem/metrology.h"

/// Viewing angles from a tally of light by direction.
namespace evenglow::design {

/// How a tally holds a distribution over directions: bins of polar angle (equal widths from 0 to 90 degrees) and
/// azimuth, index first_bin + polar * azimuth_count + azimuth.
struct DirectionBins {
  std::size_t first_bin = 0;
  int azimuth_count = 1;
  std::vector<double> ring_unit;  ///< luminance for 1 of the tally, of each polar bin
};

/// Angles at which the luminance in the plane of azimuth `azimuth_deg` (and the opposite one) has fallen to half its
/// greatest value within 45 degrees of the normal, outwards from that, linear between the middles of the bins: the side
/// lobes of prism films may be as bright as the main lobe, but are not what a display is looked at by. An azimuth on
/// the border of two bins takes both; the innermost polar bins, all of which are nearly the normal, count as one
/// direction. None if the luminance does not fall so far on both sides, or if there is no light.
///
/// Errors by the jackknife (Efron & Stein, Ann. Stat. 9, 1981) over the batches; not a number if a batch decides
/// whether there is such an angle.
std::optional<HalfAngles> half_angles(const core::Tally& tally, const DirectionBins& bins, double azimuth_deg);

}  // namespace evenglow::design
