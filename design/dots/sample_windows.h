#pragma once

#include <vector>

#include "core/dots/dot.h"
#include "design/dots/dot_store.h"
#include "design/dots/keep_out.h"

namespace evenglow::design {

/// The dots of a square cut out of the pattern, in its own unit square.
struct SampleWindow {
  double x0 = 0.0, y0 = 0.0;  ///< mm, its corner
  double size = 0.0;          ///< mm
  std::vector<double> x, y;   ///< in [0, 1)
  std::vector<double> area;   ///< of each dot's circle (mm2); square dots alike
  double slope_x = 0.0;       ///< the density within it is about 1 + slope_x (x - 1/2) + slope_y (y - 1/2) of its mean
  double slope_y = 0.0;
};

/// The dots within a square.
SampleWindow cut_window(const DotStore& dots, double x0, double y0, double size);

/// Squares of about `wanted` dots each around the places of an 8 x 8 raster, wholly in the free area; fewer where they
/// do not fit. Squares in which the density changes by more than half are left out.
std::vector<SampleWindow> sample_windows(const DotStore& dots, const FreeArea& free, double wanted);

}  // namespace evenglow::design
