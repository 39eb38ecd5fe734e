#pragma once

#include "design/report/drawing.h"

namespace evenglow::design {

/// A drawing as an inline SVG element of an HTML page. Inks become classes (`i-text`, `i-s1` ...), so that the page's
/// style sheet chooses the colors for light, dark and print.
class SvgDrawing final : public Drawing {
 public:
  SvgDrawing(double width, double height);

  void polyline(std::span<const Point> points, const Stroke& stroke) override;
  void band(std::span<const Point> outline, Ink ink) override;
  void mark(Point center, double radius, Mark shape, Ink ink) override;
  void text(Point at, std::string_view text, const TextStyle& style) override;
  double text_width(std::string_view text, const TextStyle& style) const override;

  /// The element; `label` tells it to those who cannot see it.
  std::string element(std::string_view label) const;

 private:
  double width_;
  double height_;
  std::string body_;
};

/// Class of an ink in the style sheet, without the leading `i-`: "text", "s1".
std::string ink_class(Ink ink);

}  // namespace evenglow::design
