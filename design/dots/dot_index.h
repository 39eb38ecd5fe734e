#pragma once

#include "core/dots/dot.h"
#include "design/dots/dot_store.h"
#include "design/dots/keep_out.h"

namespace evenglow::design {

/// The smallest rectangle that holds all dots whole (round ones). At least one dot.
RectangleZone bounds_of(const core::DotPattern& dots);

/// Finished dots, made quick to find by place; about 50 in a cell.
DotStore index_dots(const core::DotPattern& dots, const RectangleZone& area, int threads);

}  // namespace evenglow::design
