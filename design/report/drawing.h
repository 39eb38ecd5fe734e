#pragma once

#include <span>
#include <string>
#include <string_view>

namespace evenglow::design {

struct Point {
  double x = 0.0;  ///< px, to the right
  double y = 0.0;  ///< px, down
};

struct Box {
  double left = 0.0;
  double top = 0.0;
  double width = 0.0;
  double height = 0.0;

  double right() const { return left + width; }
  double bottom() const { return top + height; }
};

/// What a stroke or a text is for; each drawing knows the colors (a page has light and dark ones).
enum class Ink { text, muted, grid, series_1, series_2, series_3, series_4, series_5, series_6 };
/// The ink of curve `index`; begins again after six.
constexpr Ink series_ink(std::size_t index) {
  return static_cast<Ink>(static_cast<std::size_t>(Ink::series_1) + index % 6);
}

struct Stroke {
  Ink ink = Ink::text;
  double width = 1.0;  ///< px
  bool dashed = false;
};

enum class Align { left, center, right };

struct TextStyle {
  double size = 12.0;  ///< px
  Align align = Align::left;
  Ink ink = Ink::text;
  bool bold = false;
  bool upwards = false;  ///< turned by 90 degrees, read from below
};

enum class Mark { disc, ring, diamond, arrow_down };

/// A surface that lines and text can be drawn on. The point of a text is on its base line.
class Drawing {
 public:
  virtual ~Drawing() = default;
  virtual void polyline(std::span<const Point> points, const Stroke& stroke) = 0;
  virtual void band(std::span<const Point> outline, Ink ink) = 0;  ///< filled, translucent
  virtual void mark(Point center, double radius, Mark shape, Ink ink) = 0;
  virtual void text(Point at, std::string_view text, const TextStyle& style) = 0;
  virtual double text_width(std::string_view text, const TextStyle& style) const = 0;  ///< px

  void line(Point a, Point b, const Stroke& stroke) {
    const Point points[] = {a, b};
    polyline(points, stroke);
  }
};

}  // namespace evenglow::design
