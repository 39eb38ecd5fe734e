#include "design/report/svg_drawing.h"

#include <algorithm>

#include <fmt/format.h>

#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

/// To a tenth of a pixel: the page stays small.
std::string coordinates(std::span<const Point> points) {
  std::string text;
  for (const Point& p : points) text += fmt::format("{}{:.1f},{:.1f}", text.empty() ? "" : " ", p.x, p.y);
  return text;
}

std::string_view anchor(Align align) {
  if (align == Align::center) return "middle";
  return align == Align::right ? "end" : "start";
}

}  // namespace

std::string ink_class(Ink ink) {
  if (ink == Ink::text) return "text";
  if (ink == Ink::muted) return "muted";
  if (ink == Ink::grid) return "grid";
  return fmt::format("s{}", static_cast<int>(ink) - static_cast<int>(Ink::series_1) + 1);
}

SvgDrawing::SvgDrawing(double width, double height) : width_(width), height_(height) {}

void SvgDrawing::polyline(std::span<const Point> points, const Stroke& stroke) {
  body_ += fmt::format("<polyline class=\"st i-{}\" stroke-width=\"{}\"{} points=\"{}\"/>\n", ink_class(stroke.ink),
                       stroke.width, stroke.dashed ? " stroke-dasharray=\"4 3\"" : "", coordinates(points));
}

void SvgDrawing::band(std::span<const Point> outline, Ink ink) {
  body_ += fmt::format("<polygon class=\"band i-{}\" points=\"{}\"/>\n", ink_class(ink), coordinates(outline));
}

void SvgDrawing::mark(Point center, double radius, Mark shape, Ink ink) {
  const std::string name = ink_class(ink);
  if (shape == Mark::disc || shape == Mark::ring) {
    body_ += fmt::format("<circle class=\"{} i-{}\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\"/>\n",
                         shape == Mark::disc ? "fi" : "ring", name, center.x, center.y, radius);
    return;
  }
  const auto [x, y] = center;
  const double r = radius * 1.4;
  const Point diamond[] = {{x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}};
  const Point arrow[] = {{x - r, y - r}, {x + r, y - r}, {x, y + 0.6 * r}};
  const std::span<const Point> outline = shape == Mark::diamond ? std::span<const Point>(diamond) : arrow;
  body_ += fmt::format("<polygon class=\"{} i-{}\" points=\"{}\"/>\n", shape == Mark::diamond ? "ring" : "fi", name,
                       coordinates(outline));
}

void SvgDrawing::text(Point at, std::string_view text, const TextStyle& style) {
  const std::string turn = style.upwards ? fmt::format(" transform=\"rotate(-90 {:.1f} {:.1f})\"", at.x, at.y) : "";
  body_ += fmt::format(
      "<text class=\"fi i-{}\" x=\"{:.1f}\" y=\"{:.1f}\" font-size=\"{}\" text-anchor=\"{}\"{}{}>{}</text>\n",
      ink_class(style.ink), at.x, at.y, style.size, anchor(style.align), style.bold ? " font-weight=\"600\"" : "", turn,
      html_escape(text));
}

double SvgDrawing::text_width(std::string_view text, const TextStyle& style) const {
  const auto characters = std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; });
  return 0.6 * style.size * static_cast<double>(characters);  // no font at hand: an ample mean
}

std::string SvgDrawing::element(std::string_view label) const {
  return fmt::format("<svg viewBox=\"0 0 {} {}\" role=\"img\" aria-label=\"{}\">\n{}</svg>\n", width_, height_,
                     html_escape(label), body_);
}

}  // namespace evenglow::design
