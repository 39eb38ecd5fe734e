#include "tracer/microstructure/bump_placement.h"

#include <cmath>

namespace evenglow::tracer {

BumpPlacement::BumpPlacement(Form form, double axis, bool on_top)
    : x_x_(std::sin(axis)), x_y_(on_top ? -std::cos(axis) : std::cos(axis)), flip_(form == Form::kSunk ? -1.0 : 1.0), on_top_(on_top) {}

}  // namespace evenglow::tracer
