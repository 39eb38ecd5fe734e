#include "design/report/section_view.h"

#include <algorithm>
#include <array>

#include "design/report/number_format.h"
#include "design/report/svg_drawing.h"

namespace evenglow::design {
namespace {

constexpr double kWidth = 1120.0;
constexpr double kNames = 300.0;  // room for the names at the right
constexpr double kBody = 120.0;   // px, height of the thickest body
constexpr double kSheet = 34.0;
constexpr double kGap = 30.0;
constexpr double kAbove = 56.0;
constexpr double kText = 14.0;
constexpr double kLegend = 34.0;
constexpr double kStep = 18.0;  // least distance of two names

Ink ink_of(PolarizationLook look) {
  switch (look) {
    case PolarizationLook::along_x:
      return Ink::series_1;
    case PolarizationLook::along_y:
      return Ink::series_2;
    case PolarizationLook::circular:
      return Ink::series_3;
    case PolarizationLook::unpolarized:
      break;
  }
  return Ink::muted;
}

double thickest(const std::vector<SectionLayer>& layers) {
  double most = 0.0;
  for (const SectionLayer& layer : layers) most = std::max(most, layer.top - layer.bottom);
  return most;
}

/// Bodies as boxes, films as lines, and their names beside them, moved apart where they would meet.
void draw_layers(const SectionView& view, const SectionHeights& height, SvgDrawing& drawing) {
  const double right = kWidth - kNames;
  double name_below = 1e9;
  for (const SectionLayer& layer : view.layers) {
    const double top = height(layer.top);
    const double bottom = height(layer.bottom);
    if (layer.kind == LayerKind::body) {
      const Point box[] = {{0, bottom}, {right, bottom}, {right, top}, {0, top}};
      drawing.band(box, Ink::series_1);
    }
    drawing.line({0, top}, {right, top}, {Ink::text, layer.kind == LayerKind::body ? 1.0 : 2.2, false});
    if (layer.kind == LayerKind::body) drawing.line({0, bottom}, {right, bottom}, {Ink::text, 1.0, false});
    const double middle = 0.5 * (top + bottom);
    const double at = std::min(middle + 0.35 * kText, name_below - kStep);
    name_below = at;
    drawing.line({right + 4, middle}, {right + 22, at - 0.35 * kText}, {Ink::muted, 0.8, false});
    const TextStyle style{kText, Align::left, Ink::text, false, false};
    drawing.text({right + 26, at}, layer.name, style);
  }
}

Point place(const SectionView& view, const SectionHeights& height, const Point& p) {
  return {(p.x - view.x_min) / (view.x_max - view.x_min) * (kWidth - kNames), height(p.y)};
}

/// The part of a stretch within the picture's width; false: none of it.
bool clip(Point& a, Point& b, double right) {
  if (a.x > b.x) {
    const bool some = clip(b, a, right);
    return some;
  }
  if (b.x < 0.0 || a.x > right) return false;
  const Point first = a;
  const Point last = b;
  const double slope = last.x > first.x ? (last.y - first.y) / (last.x - first.x) : 0.0;
  if (a.x < 0.0) a = {0.0, first.y - first.x * slope};
  if (b.x > right) b = {right, first.y + (right - first.x) * slope};
  return true;
}

/// Heights at which the map from z to px bends, between the two ends of a stretch.
std::vector<Point> bent(const SectionView& view, const SectionHeights& height, const Point& a, const Point& b) {
  std::vector<double> shares = {0.0, 1.0};
  if (a.y != b.y) {
    for (const SectionLayer& layer : view.layers) {
      for (const double z : {layer.bottom, layer.top}) {
        const double share = (z - a.y) / (b.y - a.y);
        if (share > 0.0 && share < 1.0) shares.push_back(share);
      }
    }
  }
  std::sort(shares.begin(), shares.end());
  std::vector<Point> points;
  points.reserve(shares.size());
  for (const double s : shares) points.push_back(place(view, height, {a.x + s * (b.x - a.x), a.y + s * (b.y - a.y)}));
  return points;
}

void draw_path(const SectionView& view, const SectionPath& path, const SectionHeights& height, SvgDrawing& drawing) {
  const double right = kWidth - kNames;
  for (std::size_t i = 0; i + 1 < path.points.size(); ++i) {
    const auto points = bent(view, height, path.points[i], path.points[i + 1]);
    for (std::size_t j = 0; j + 1 < points.size(); ++j) {
      Point a = points[j];
      Point b = points[j + 1];
      if (clip(a, b, right)) drawing.line(a, b, {ink_of(path.looks[i]), 1.1, false});
    }
  }
  if (path.points.empty()) return;
  const Point end = place(view, height, path.points.back());
  const bool shown = end.x >= 0.0 && end.x <= right;
  if (!shown) return;
  const bool leaves = path.fate.starts_with("leaves");
  drawing.mark(end, 2.6, leaves ? Mark::disc : Mark::ring, ink_of(path.looks.back()));
}

void draw_legend(const SectionView& view, double y, SvgDrawing& drawing) {
  const std::array<std::pair<PolarizationLook, const char*>, 4> entries = {
      {{PolarizationLook::along_x, "field along the length (x)"},
       {PolarizationLook::along_y, "field along the width (y)"},
       {PolarizationLook::circular, "circular"},
       {PolarizationLook::unpolarized, "little polarized"}}};
  double x = 0.0;
  const TextStyle style{kText, Align::left, Ink::muted, false, false};
  for (const auto& [look, name] : entries) {
    drawing.line({x, y - 4}, {x + 22, y - 4}, {ink_of(look), 2.5, false});
    drawing.text({x + 28, y}, name, style);
    x += 56.0 + drawing.text_width(name, style);
  }
  drawing.text({kWidth, y}, "x from " + rounded(view.x_min) + " to " + rounded(view.x_max) + " mm",
               {kText, Align::right, Ink::muted, false, false});
}

SvgDrawing drawn(const SectionView& view) {
  const SectionHeights height(view.layers, kAbove);
  SvgDrawing drawing(kWidth, height.picture_height() + kLegend);
  draw_layers(view, height, drawing);
  for (const SectionPath& path : view.paths) draw_path(view, path, height, drawing);
  draw_legend(view, height.picture_height() + kLegend - 8.0, drawing);
  return drawing;
}

std::string label(const SectionView& view) {
  return "The backlight in section with the ways of " + std::to_string(view.paths.size()) +
         " photons; heights are not to scale";
}

}  // namespace

SectionHeights::SectionHeights(const std::vector<SectionLayer>& layers, double picture_top) {
  const double most = thickest(layers);
  double px = 0.0;
  double z = layers.empty() ? 0.0 : layers.front().bottom;
  marks_.push_back({z - 1.0, px + kGap});
  marks_.push_back({z, px});
  for (const SectionLayer& layer : layers) {
    if (layer.bottom > z) marks_.push_back({z = layer.bottom, px -= kGap});
    if (layer.top > z) {
      const double share = (layer.top - layer.bottom) / most;
      marks_.push_back({z = layer.top, px -= std::max(kSheet, share * kBody)});
    }
  }
  marks_.push_back({z + 1.0, px -= picture_top});
  for (Mark& mark : marks_) mark.px -= px;
}

double SectionHeights::operator()(double z) const {
  if (z <= marks_.front().z) return marks_.front().px;
  for (std::size_t i = 1; i < marks_.size(); ++i) {
    const Mark& a = marks_[i - 1];
    const Mark& b = marks_[i];
    if (z <= b.z) return a.px + (z - a.z) / (b.z - a.z) * (b.px - a.px);
  }
  return marks_.back().px;
}

std::string section_svg(const SectionView& view) {
  return drawn(view).element(label(view));
}

std::string section_svg_file(const SectionView& view) {
  constexpr std::string_view kStyle =
      "<style>:root { --bg: #ffffff; } svg { background: #ffffff; font-family: sans-serif; }\n"
      ".i-text { --c: #1c2126; } .i-muted { --c: #8a939b; } .i-s1 { --c: #1761b8; } .i-s2 { --c: #c25708; } "
      ".i-s3 { --c: #15805f; }\n"
      ".st { fill: none; stroke: var(--c); stroke-linejoin: round; } .fi { fill: var(--c); } .band { fill: var(--c); "
      "opacity: .12; } .ring { fill: #ffffff; stroke: var(--c); }</style>\n";
  std::string svg = section_svg(view);
  svg.insert(svg.find("<svg ") + 5, "xmlns=\"http://www.w3.org/2000/svg\" ");
  svg.insert(svg.find('>') + 1, "\n" + std::string(kStyle));
  return svg;
}

}  // namespace evenglow::design
