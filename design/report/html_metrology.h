#pragma once

#include <string>
#include <vector>

#include "design/report/page_data.h"
#include "design/report/report.h"

/// Sections of the page on color, viewing angles and hot spots; empty for a report without them.
namespace evenglow::design {

/// Figures of the color, maps of delta u'v', its error, u' and v'.
std::string color_section(const Report& report, PageData& data);
/// A table of the angles at half the greatest luminance; a column for each report, rows of spots for a single one.
std::string half_angle_table(const std::vector<const Report*>& reports);
/// Ratio of the luminance in front of the LEDs to that between them.
std::string hot_spot_section(const Report& report, PageData& data);
/// That ratio against the distance from the edge, a curve for each row of LEDs.
CurvePlot hot_spot_plot(const std::vector<HotSpots>& rows);

}  // namespace evenglow::design
