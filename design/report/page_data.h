#pragma once

#include <string>
#include <string_view>

#include "core/math/cell_field.h"
#include "design/report/curve_plot.h"
#include "design/report/report.h"

namespace evenglow::design {

/// What is told of a map beside its values.
struct MapFacts {
  std::string_view name;
  std::string_view quantity;  ///< maps of one quantity share their sections
  std::string_view unit;
  std::string_view colors;
  ValueScale scale;  ///< of the colors
  int series = -1;   ///< color of its curve; -1: by its place
};

/// The numbers that the script of a page draws and reads out, collected while the page is written. Numbers keep five
/// significant digits: enough for a read-out, and the page stays small.
class PageData {
 public:
  /// A map with its standard errors (or null); gives its name for `data-map`.
  std::string add_map(const core::CellField& field, const core::CellField* se, const MapFacts& facts);
  /// A distribution over directions with the value at the upper end of its colors (the lower is 0), for `data-polar`.
  std::string add_polar(const AngularLuminance& angular, std::string_view unit, double top);
  /// Curves with the place of their axes, as shares of the picture's width, for `data-curves`.
  std::string add_curves(const CurvePlot& plot, const PlotFrame& frame, double picture_width);

  /// One JSON object, safe within a `<script>` element.
  std::string json() const;

 private:
  std::string add(std::string object);
  std::string objects_;
  int count_ = 0;
};

}  // namespace evenglow::design
