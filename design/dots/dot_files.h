#pragma once

#include <filesystem>
#include <string>

#include "core/dots/dot.h"
#include "design/dots/keep_out.h"

/// The files that a tool maker reads. Each is written piece by piece; core::Error names a path that cannot be written.
namespace evenglow::design {

/// What all of the files tell besides the dots.
struct DotSheet {
  const core::DotPattern& dots;
  core::Footprint footprint = core::Footprint::round;
  RectangleZone plate;  ///< mm
  std::string title;    ///< one line
};

/// `x_mm,y_mm,diameter_um,angle_deg`, places to 1 nm.
void write_dot_csv(const DotSheet& sheet, const std::filesystem::path& path);

/// ASCII DXF, release 12: a CIRCLE for each dot (a closed POLYLINE for a square one) on the layer DOTS, lengths in mm.
/// Source: Autodesk, DXF Reference.
void write_dot_dxf(const DotSheet& sheet, const std::filesystem::path& path);

/// GDSII stream, release 6: database unit 1 nm, user unit 1 um. One structure for each size (round dots: a regular
/// polygon of 64 corners of the dot's area; square ones: the square) and a top structure DOTS with a reference for each
/// dot. Source: Calma, GDS II Stream Format Manual, release 6.0 (1987). Throws core::Error for places beyond +-2.1 m.
void write_dot_gds(const DotSheet& sheet, const std::filesystem::path& path);

/// SVG in mm, y up as on the plate: the plate's outline and all dots, or, of more than `most` dots, those of a part in
/// its middle (the title says so).
void write_dot_svg(const DotSheet& sheet, const std::filesystem::path& path, std::size_t most = 250000);

}  // namespace evenglow::design
