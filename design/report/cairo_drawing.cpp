#include "design/report/cairo_drawing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <numbers>

#include <cairo/cairo.h>

#include "core/base/error.h"
#include "design/report/output_file.h"
#include "design/report/text_escape.h"

namespace evenglow::design {
namespace {

/// Dark and distinct on white, also for the color-blind; in the order of `Ink`.
constexpr std::array<Rgb, 9> ink_colors{{{0.11, 0.13, 0.16},
                                         {0.40, 0.43, 0.47},
                                         {0.87, 0.88, 0.90},
                                         {0.09, 0.38, 0.72},
                                         {0.80, 0.36, 0.05},
                                         {0.10, 0.53, 0.40},
                                         {0.55, 0.30, 0.68},
                                         {0.63, 0.49, 0.03},
                                         {0.76, 0.20, 0.35}}};

const Rgb& color_of(Ink ink) {
  return ink_colors[static_cast<std::size_t>(ink)];
}

void set_color(cairo_t* context, const Rgb& c, double alpha = 1.0) {
  cairo_set_source_rgba(context, c.red, c.green, c.blue, alpha);
}

void set_font(cairo_t* context, const TextStyle& style) {
  cairo_select_font_face(context, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         style.bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(context, style.size);
}

void trace_path(cairo_t* context, std::span<const Point> points) {
  cairo_new_path(context);
  for (const Point& p : points) cairo_line_to(context, p.x, p.y);
}

cairo_status_t append(void* closure, const unsigned char* data, unsigned length) {
  static_cast<std::string*>(closure)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void require(cairo_status_t status, const char* action) {
  if (status != CAIRO_STATUS_SUCCESS) {
    throw core::Error(std::string("cannot ") + action + ": " + cairo_status_to_string(status));
  }
}

}  // namespace

struct CairoDrawing::State {
  cairo_surface_t* surface;
  cairo_t* context;

  State(int width, int height)
      : surface(cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height)), context(cairo_create(surface)) {}
  State(const State&) = delete;
  State& operator=(const State&) = delete;
  ~State() {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
  }
};

CairoDrawing::CairoDrawing(int width, int height) : state_(std::make_unique<State>(width, height)) {
  require(cairo_status(state_->context), "start a picture");
  set_color(state_->context, {1, 1, 1});
  cairo_paint(state_->context);
  cairo_set_line_join(state_->context, CAIRO_LINE_JOIN_ROUND);
}

CairoDrawing::~CairoDrawing() = default;

void CairoDrawing::polyline(std::span<const Point> points, const Stroke& stroke) {
  cairo_t* context = state_->context;
  trace_path(context, points);
  const std::array<double, 2> dashes{4.0 * stroke.width, 3.0 * stroke.width};
  cairo_set_dash(context, dashes.data(), stroke.dashed ? 2 : 0, 0.0);
  cairo_set_line_width(context, stroke.width);
  set_color(context, color_of(stroke.ink));
  cairo_stroke(context);
}

void CairoDrawing::band(std::span<const Point> outline, Ink ink) {
  trace_path(state_->context, outline);
  set_color(state_->context, color_of(ink), 0.2);
  cairo_fill(state_->context);
}

void CairoDrawing::mark(Point center, double radius, Mark shape, Ink ink) {
  cairo_t* context = state_->context;
  const auto [x, y] = center;
  const double r = radius * 1.4;
  cairo_new_path(context);
  if (shape == Mark::disc || shape == Mark::ring) {
    cairo_arc(context, x, y, radius, 0.0, 2.0 * std::numbers::pi);
  } else if (shape == Mark::diamond) {
    trace_path(context, std::array<Point, 4>{{{x, y - r}, {x + r, y}, {x, y + r}, {x - r, y}}});
  } else {
    trace_path(context, std::array<Point, 3>{{{x - r, y - r}, {x + r, y - r}, {x, y + 0.6 * r}}});
  }
  cairo_close_path(context);
  const bool open = shape == Mark::ring || shape == Mark::diamond;
  set_color(context, open ? Rgb{1, 1, 1} : color_of(ink));
  cairo_fill_preserve(context);
  set_color(context, color_of(ink));
  cairo_set_dash(context, nullptr, 0, 0.0);
  cairo_set_line_width(context, 0.35 * radius);
  cairo_stroke(context);
}

void CairoDrawing::text(Point at, std::string_view text, const TextStyle& style) {
  cairo_t* context = state_->context;
  const double width = text_width(text, style);
  const double shift = style.align == Align::left ? 0.0 : (style.align == Align::center ? 0.5 : 1.0) * width;
  cairo_save(context);
  cairo_translate(context, at.x, at.y);
  if (style.upwards) cairo_rotate(context, -0.5 * std::numbers::pi);
  cairo_move_to(context, -shift, 0.0);
  set_font(context, style);
  set_color(context, color_of(style.ink));
  // Cairo refuses ill-formed text for good: the whole drawing would stay empty from there on.
  cairo_show_text(context, clean_utf8(one_line(text)).c_str());
  cairo_restore(context);
}

double CairoDrawing::text_width(std::string_view text, const TextStyle& style) const {
  cairo_text_extents_t extents;
  set_font(state_->context, style);
  cairo_text_extents(state_->context, clean_utf8(one_line(text)).c_str(), &extents);
  return extents.x_advance;
}

void CairoDrawing::cells(const Box& box, int nx, int ny, const std::vector<Rgb>& colors) {
  core::expects(nx > 0 && ny > 0 && colors.size() == static_cast<std::size_t>(nx) * static_cast<std::size_t>(ny),
                "one color for each cell");
  cairo_t* context = state_->context;
  cairo_surface_t* image = cairo_image_surface_create(CAIRO_FORMAT_RGB24, nx, ny);
  require(cairo_surface_status(image), "draw a map");
  unsigned char* data = cairo_image_surface_get_data(image);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(image));
  const auto byte = [](double v) { return static_cast<std::uint32_t>(std::lround(v * 255.0)); };
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const Rgb& c = colors[i];
    const std::uint32_t pixel = byte(c.red) << 16U | byte(c.green) << 8U | byte(c.blue);
    const auto columns = static_cast<std::size_t>(nx);
    std::memcpy(data + i / columns * stride + i % columns * sizeof pixel, &pixel, sizeof pixel);
  }
  cairo_surface_mark_dirty(image);
  cairo_save(context);
  cairo_rectangle(context, box.left, box.top, box.width, box.height);
  cairo_clip(context);
  cairo_translate(context, box.left, box.top);
  cairo_scale(context, box.width / nx, box.height / ny);
  cairo_set_source_surface(context, image, 0.0, 0.0);
  cairo_pattern_set_filter(cairo_get_source(context), CAIRO_FILTER_NEAREST);
  cairo_pattern_set_extend(cairo_get_source(context), CAIRO_EXTEND_PAD);
  cairo_paint(context);
  cairo_restore(context);
  cairo_surface_destroy(image);
}

Rgb CairoDrawing::pixel(int x, int y) const {
  cairo_surface_t* surface = state_->surface;
  core::expects(
      x >= 0 && y >= 0 && x < cairo_image_surface_get_width(surface) && y < cairo_image_surface_get_height(surface),
      "a pixel within the picture");
  cairo_surface_flush(surface);
  const auto stride = static_cast<std::size_t>(cairo_image_surface_get_stride(surface));
  std::uint32_t value = 0;
  const std::size_t at = static_cast<std::size_t>(y) * stride + static_cast<std::size_t>(x) * sizeof value;
  std::memcpy(&value, cairo_image_surface_get_data(surface) + at, sizeof value);
  const auto part = [&](unsigned shift) { return static_cast<double>(value >> shift & 255U) / 255.0; };
  return {part(16), part(8), part(0)};
}

void CairoDrawing::save(const std::filesystem::path& path) {
  require(cairo_status(state_->context), "draw a picture");
  std::string png;
  require(cairo_surface_write_to_png_stream(state_->surface, append, &png), "write a PNG");
  write_file(path, png);
}

std::string fitted(const Drawing& drawing, std::string text, const TextStyle& style, double width) {
  text = clean_utf8(one_line(text));
  if (drawing.text_width(text, style) <= width) return text;
  while (!text.empty() && drawing.text_width(text + "\u2026", style) > width) {
    while (!text.empty() && (text.back() & 0xC0) == 0x80) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  return text + "\u2026";
}

}  // namespace evenglow::design
