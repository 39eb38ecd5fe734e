#pragma once

#include <string>

#include "core/math/cell_field.h"
#include "design/report/cairo_drawing.h"
#include "design/report/value_scale.h"

namespace evenglow::design {

/// A map with axes in mm and the true proportions of the panel.
struct MapPlot {
  std::string title;
  std::string caption;  ///< one line below the title
  const core::CellField* field = nullptr;
  ValueScale scale;
  const ColorMap* colors = nullptr;
  double text_room = 0.0;  ///< px to the right of the box that title and caption may use
};

/// Room that a map takes at most in such a box, titles and axes included (px). The map touches one of the two limits.
struct PlotSize {
  double width = 0.0;
  double height = 0.0;
};
PlotSize map_size(const core::CellField& field, const PlotSize& limits, double text_size);
/// Where a map's caption ends if nothing is cut off, px from the left of its box.
double caption_right(const Drawing& drawing, const MapPlot& map, double text_size);

/// Draws the map as large as the box allows and returns where its cells stand; without values, only the title and a
/// remark.
Box draw_map(CairoDrawing& drawing, const MapPlot& map, const Box& box, double text_size);

/// A vertical color bar with ticks, `unit` below it. Ticks and unit take another 5 sizes of the text to the right.
void draw_color_bar(CairoDrawing& drawing, const ColorMap& colors, const ValueScale& scale, const std::string& unit,
                    const Box& box, double text_size);

}  // namespace evenglow::design
