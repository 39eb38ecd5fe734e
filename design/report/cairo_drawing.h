#pragma once

#include <filesystem>
#include <memory>
#include <vector>

#include "design/report/color_map.h"
#include "design/report/drawing.h"

namespace evenglow::design {

/// A picture on white, saved as PNG. The one door to cairo.
class CairoDrawing final : public Drawing {
 public:
  /// Size in px, at least 1. Throws core::Error if there is no memory for it.
  CairoDrawing(int width, int height);
  ~CairoDrawing() override;

  void polyline(std::span<const Point> points, const Stroke& stroke) override;
  void band(std::span<const Point> outline, Ink ink) override;
  void mark(Point center, double radius, Mark shape, Ink ink) override;
  void text(Point at, std::string_view text, const TextStyle& style) override;
  double text_width(std::string_view text, const TextStyle& style) const override;

  /// Fills a box with nx x ny colored cells; index row * nx + column, the first row on top.
  void cells(const Box& box, int nx, int ny, const std::vector<Rgb>& colors);

  /// Color of the pixel in column x and row y, both within the picture.
  Rgb pixel(int x, int y) const;

  /// Replaces a file that is there. Throws core::Error that names the path if it cannot be written.
  void save(const std::filesystem::path& path);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Text cut to a width, with an ellipsis if anything was cut.
std::string fitted(const Drawing& drawing, std::string text, const TextStyle& style, double width);

}  // namespace evenglow::design
