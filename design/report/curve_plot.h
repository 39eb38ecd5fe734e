#pragma once

#include <string>
#include <vector>

#include "design/report/axis.h"
#include "design/report/drawing.h"

namespace evenglow::design {

/// A curve with standard errors. Points that are not finite are left out.
struct Curve {
  std::string name;
  Ink ink = Ink::series_1;
  std::vector<double> x;
  std::vector<double> y;
  std::vector<double> se;  ///< as many as y, or none; drawn as bars of +-1 standard error, as a band without marks
  bool marked = true;
  bool joined = true;
  bool dashed = false;
  Mark shape = Mark::disc;
  bool in_legend = true;
  bool stepped = false;  ///< constant about each point to the middle of its neighbors: a histogram
};

struct CurvePlot {
  std::string title;
  std::string x_label;
  std::string y_label;
  bool log_y = false;  ///< values that are not positive become arrows on the lower edge
  bool integer_x = false;
  bool from_zero = false;  ///< the y axis holds zero
  std::vector<Curve> curves;
};

/// Where the curves stand in the picture, for read-outs.
struct PlotFrame {
  Box area;  ///< px, within the axes
  Axis x;
  Axis y;

  Point at(double x_value, double y_value) const;  ///< px
};

/// Axes that show all of the plot; sensible ones if there is nothing to show.
Axis x_axis_of(const CurvePlot& plot, int wanted_ticks = 6);
Axis y_axis_of(const CurvePlot& plot);

/// Draws title, axes, curves and, if asked, a legend into the box; all sizes follow the size of the text (px).
PlotFrame draw_curves(Drawing& drawing, const CurvePlot& plot, const Box& box, double text_size, bool with_legend);

}  // namespace evenglow::design
