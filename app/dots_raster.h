#pragma once

#include <vector>

#include "core/dots/dot.h"
#include "core/math/cell_field.h"
#include "design/dots/keep_out.h"

namespace evenglow::app {

/// Share of each pixel under dots, each dot's area spread over the four pixels nearest to its center: for pixels that
/// are not much smaller than dots.
core::CellField coarse_raster(const core::DotPattern& dots, const design::RectangleZone& area, int longest_side);

/// The dots of a square as they look, edges smooth: for pixels much smaller than dots.
core::CellField fine_raster(const core::DotPattern& dots, core::Footprint footprint,
                            const design::RectangleZone& square, int pixels);

/// Three squares of about 20 x 20 dots: where 2 %, half and 98 % of the plate's places have fewer dots.
std::vector<design::RectangleZone> telling_squares(const core::DotPattern& dots, const design::RectangleZone& plate);

}  // namespace evenglow::app
