#include "design/report/map_plot.h"

#include <algorithm>

#include "core/math/cell_index.h"
#include "design/report/axis.h"

namespace evenglow::design {
namespace {

/// Room around a map, in sizes of the text.
constexpr double room_left = 4.6;
constexpr double room_right = 1.2;
constexpr double room_top = 3.6;
constexpr double room_bottom = 3.2;

double size_x(const core::CellGrid& grid) {
  return grid.nx * grid.dx;
}
double size_y(const core::CellGrid& grid) {
  return grid.ny * grid.dy;
}

Box fit(const core::CellGrid& grid, const Box& box, double text_size) {
  const double width = std::max(box.width - (room_left + room_right) * text_size, 1.0);
  const double height = std::max(box.height - (room_top + room_bottom) * text_size, 1.0);
  const double px_per_mm = std::min(width / size_x(grid), height / size_y(grid));
  return {box.left + room_left * text_size, box.top + room_top * text_size, px_per_mm * size_x(grid),
          px_per_mm * size_y(grid)};
}

void draw_axes(CairoDrawing& drawing, const core::CellGrid& grid, const Box& area, double size) {
  const auto ticks = [&](double length) { return static_cast<int>(std::clamp(length / size / 5.0, 1.0, 8.0)); };
  const TextStyle centered{size, Align::center, Ink::muted, false, false};
  const TextStyle right{size, Align::right, Ink::muted, false, false};
  for (const Tick& tick : linear_axis({grid.x0, grid.x0 + size_x(grid)}, ticks(area.width)).ticks) {
    const double x = area.left + (tick.value - grid.x0) / size_x(grid) * area.width;
    drawing.line({x, area.bottom()}, {x, area.bottom() + 0.35 * size}, {Ink::muted, size / 12});
    drawing.text({x, area.bottom() + 1.4 * size}, tick.label, centered);
  }
  for (const Tick& tick : linear_axis({grid.y0, grid.y0 + size_y(grid)}, ticks(area.height)).ticks) {
    const double y = area.bottom() - (tick.value - grid.y0) / size_y(grid) * area.height;
    drawing.line({area.left - 0.35 * size, y}, {area.left, y}, {Ink::muted, size / 12});
    drawing.text({area.left - 0.6 * size, y + 0.35 * size}, tick.label, right);
  }
  drawing.text({area.left + 0.5 * area.width, area.bottom() + 2.8 * size}, "x (mm)", centered);
  TextStyle upwards = centered;
  upwards.upwards = true;
  drawing.text({area.left - 3.3 * size, area.top + 0.5 * area.height}, "y (mm)", upwards);
}

/// From the top row, the greatest y, downwards.
std::vector<Rgb> colors_of(const MapPlot& map) {
  const core::CellGrid& grid = map.field->grid;
  std::vector<Rgb> colors;
  colors.reserve(grid.size());
  for (int iy = grid.ny - 1; iy >= 0; --iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double value = map.field->values[core::cell_index(grid.nx, ix, iy)];
      colors.push_back(map.colors->at(map.scale.share(value)));
    }
  }
  return colors;
}

}  // namespace

PlotSize map_size(const core::CellField& field, const PlotSize& limits, double text_size) {
  const Box area = fit(field.grid, {0, 0, limits.width, limits.height}, text_size);
  return {area.width + (room_left + room_right) * text_size, area.height + (room_top + room_bottom) * text_size};
}

double caption_right(const Drawing& drawing, const MapPlot& map, double text_size) {
  return room_left * text_size + drawing.text_width(map.caption, {text_size, Align::left, Ink::muted, false, false});
}

Box draw_map(CairoDrawing& drawing, const MapPlot& map, const Box& box, double text_size) {
  const TextStyle title{1.15 * text_size, Align::left, Ink::text, true, false};
  const TextStyle caption{text_size, Align::left, Ink::muted, false, false};
  const Box area = fit(map.field->grid, box, text_size);
  const double width = box.right() + map.text_room - area.left;
  const bool filled = is_filled(*map.field);
  drawing.text({area.left, box.top + 1.2 * text_size}, fitted(drawing, map.title, title, width), title);
  drawing.text({area.left, box.top + 2.8 * text_size},
               fitted(drawing, filled ? map.caption : "no values", caption, width), caption);
  if (!filled) return area;
  drawing.cells(area, map.field->grid.nx, map.field->grid.ny, colors_of(map));
  draw_axes(drawing, map.field->grid, area, text_size);
  return area;
}

void draw_color_bar(CairoDrawing& drawing, const ColorMap& colors, const ValueScale& scale, const std::string& unit,
                    const Box& box, double text_size) {
  std::vector<Rgb> shades;
  for (int i = 255; i >= 0; --i) shades.push_back(colors.at(i / 255.0));
  drawing.cells(box, 1, 256, shades);
  const int wanted = static_cast<int>(std::clamp(box.height / text_size / 3.0, 2.0, 8.0));
  const TextStyle style{text_size, Align::left, Ink::muted, false, false};
  for (const Tick& tick : linear_axis(scale, wanted).ticks) {
    const double y = box.bottom() - scale.share(tick.value) * box.height;
    drawing.line({box.right(), y}, {box.right() + 0.35 * text_size, y}, {Ink::muted, text_size / 12});
    drawing.text({box.right() + 0.6 * text_size, y + 0.35 * text_size}, tick.label, style);
  }
  drawing.text({box.left, box.bottom() + 1.6 * text_size}, unit, style);
}

}  // namespace evenglow::design
