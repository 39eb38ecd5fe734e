#pragma once

#include <string>
#include <vector>

#include "design/report/curve_plot.h"
#include "design/report/page_data.h"

/// Figures of the page. Plain text comes in, escaped HTML goes out.
namespace evenglow::design {

struct MapFigure {
  std::string title;
  std::string caption;
  const core::CellField* field = nullptr;
  const core::CellField* se = nullptr;  ///< or none
  std::string unit;
  std::string colors;  ///< "luminance", "density" or "difference"
  ValueScale scale;
  std::string quantity{};  ///< maps of one quantity in a group share the sections; empty: that of the colors
  int series = -1;         ///< color of its curve in the sections (`series_ink`); -1: by its place in the group
};

/// A map with axes in mm, color bar and read-out; a remark if the field has no values.
std::string map_figure(const MapFigure& map, PageData& data);

/// Curves as inline SVG with a legend and read-out. `note` explains what the legend leaves out.
std::string curve_figure(const CurvePlot& plot, const std::string& note, PageData& data);

/// Luminance by direction as a disc: the normal in the center, grazing at the rim. `top` (cd/m2, > 0) has the
/// brightest color.
std::string polar_figure(const std::string& title, const AngularLuminance& angular, double top, PageData& data);

/// Figures side by side while there is room; `layout` is "two" or "three". `id` not empty: the group has switches of
/// scale (common, or one for each map) and colors (perceptually uniform, or the rainbow of the literature), and below
/// it the sections along x and y through the cell that is pointed at, of all maps of that quantity.
std::string figure_group(const std::string& layout, const std::string& figures, const std::string& id);

}  // namespace evenglow::design
