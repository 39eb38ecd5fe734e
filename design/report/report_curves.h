#pragma once

#include <vector>

#include "design/report/curve_plot.h"
#include "design/report/report.h"

/// The curves of a report, ready to be drawn. With several reports, one color for each.
namespace evenglow::design {

/// RMS non-uniformity (percent) by step: raw, with the noise taken off, and the final judgment; of one report
/// also the noise of each step.
CurvePlot rms_plot(const std::vector<const Report*>& reports);

/// Efficiency (percent) by step and as finally judged.
CurvePlot efficiency_plot(const std::vector<const Report*>& reports);

enum class SectionDirection { along_x, along_y };

/// Luminance by polar angle of view (degrees, negative on the far side) in the plane of azimuth 0 / 180 (`along_x`)
/// or 90 / 270 degrees. Reports without an angular distribution are left out.
CurvePlot angular_section(const std::vector<const Report*>& reports, SectionDirection direction);

/// Luminance towards polar bin `polar` and azimuth `azimuth_deg`; the mean of the two bins if it is their border.
core::Estimate luminance_towards(const AngularLuminance& angular, std::size_t polar, double azimuth_deg);

}  // namespace evenglow::design
