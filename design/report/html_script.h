#pragma once

#include <string_view>

/// The parts of the page's script, in the order in which they stand there; each may use what is above it.
namespace evenglow::design {

/// Maps: colors, scales, read-out, the cell that is pointed at.
std::string_view map_script();
/// The sections along x and y through that cell.
std::string_view section_script();
/// Discs of luminance by direction.
std::string_view direction_script();
/// Read-out of curves.
std::string_view curve_script();

}  // namespace evenglow::design
