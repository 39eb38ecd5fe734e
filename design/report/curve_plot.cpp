#include "design/report/curve_plot.h"

#include <algorithm>
#include <cmath>
#include <ranges>

namespace evenglow::design {
namespace {

double clamped(double value, double low, double high) {
  return std::min(std::max(value, low), high);
}

/// One plot on its way to a drawing.
class CurvePainter {
 public:
  CurvePainter(Drawing& drawing, const PlotFrame& frame, double text_size)
      : drawing_(drawing), frame_(frame), size_(text_size) {}

  void axes(const CurvePlot& plot, const Box& box) const {
    const Box& area = frame_.area;
    for (const Tick& tick : frame_.y.ticks) {
      const double y = frame_.at(0.0, tick.value).y;
      drawing_.line({area.left, y}, {area.right(), y}, {Ink::grid, size_ / 14});
      drawing_.text({area.left - 0.5 * size_, y + 0.35 * size_}, tick.label, style(Align::right, Ink::muted));
    }
    for (const Tick& tick : frame_.x.ticks) {
      const double x = frame_.at(tick.value, 0.0).x;
      drawing_.line({x, area.bottom()}, {x, area.bottom() + 0.35 * size_}, {Ink::muted, size_ / 14});
      drawing_.text({x, area.bottom() + 1.4 * size_}, tick.label, style(Align::center, Ink::muted));
    }
    drawing_.line({area.left, area.bottom()}, {area.right(), area.bottom()}, {Ink::muted, size_ / 12});
    drawing_.text({area.left + 0.5 * area.width, area.bottom() + 2.8 * size_}, plot.x_label,
                  style(Align::center, Ink::muted));
    if (!plot.title.empty()) {
      TextStyle title = style(Align::left, Ink::text);
      title.bold = true;
      drawing_.text({box.left, box.top + 1.1 * size_}, plot.title, title);
    }
    drawing_.text({box.left, area.top - 1.15 * size_}, plot.y_label, style(Align::left, Ink::muted));
  }

  void curve(const Curve& curve) const {
    if (!curve.marked) band(curve);
    if (curve.joined) polyline(curve);
    for (std::size_t i = 0; curve.marked && i < curve.y.size(); ++i) point(curve, i);
  }

  void legend(const CurvePlot& plot, const Box& box) const {
    double x = box.right();
    for (const Curve& curve : std::views::reverse(plot.curves)) {
      if (!curve.in_legend) continue;
      x -= drawing_.text_width(curve.name, style(Align::left, Ink::text));
      const double y = box.top + 1.1 * size_;
      drawing_.text({x, y}, curve.name, style(Align::left, Ink::text));
      const double from = x - 2.4 * size_;
      const double to = x - 0.5 * size_;
      const double middle = y - 0.35 * size_;
      if (curve.joined) drawing_.line({from, middle}, {to, middle}, stroke(curve));
      if (curve.marked) drawing_.mark({0.5 * (from + to), middle}, radius(), curve.shape, curve.ink);
      x = from - 1.2 * size_;
    }
  }

 private:
  TextStyle style(Align align, Ink ink) const { return {size_, align, ink, false, false}; }
  Stroke stroke(const Curve& curve) const { return {curve.ink, curve.dashed ? size_ / 9 : size_ / 6.5, curve.dashed}; }
  double radius() const { return size_ / 3.4; }
  bool shown(const Curve& curve, std::size_t i) const {
    return i < curve.x.size() && std::isfinite(curve.x[i]) && std::isfinite(curve.y[i]);
  }
  bool off_scale(double y) const { return frame_.y.logarithmic && y < frame_.y.range.low; }

  Point inside(double x, double y) const {
    Point p = frame_.at(x, y);
    p.y = clamped(p.y, frame_.area.top, frame_.area.bottom());
    return p;
  }

  void polyline(const Curve& curve) const {
    std::vector<Point> run;
    const auto flush = [&] {
      if (run.size() > 1) drawing_.polyline(run, stroke(curve));
      run.clear();
    };
    for (std::size_t i = 0; i < curve.y.size(); ++i) {
      if (!shown(curve, i)) {
        flush();
      } else if (curve.stepped) {
        run.push_back(inside(border(curve, i, -1), curve.y[i]));
        run.push_back(inside(border(curve, i, 1), curve.y[i]));
      } else {
        run.push_back(inside(curve.x[i], curve.y[i]));
      }
    }
    flush();
  }

  /// Middle between point i and its neighbor on this side; at the ends as far as on the other side, within the axes.
  double border(const Curve& curve, std::size_t i, int side) const {
    const std::size_t last = curve.x.size() - 1;
    const bool outer = side < 0 ? i == 0 : i == last;
    const std::size_t neighbor = (side < 0) == outer ? i + 1 : i - 1;
    if (last == 0) return clamped(curve.x[i] + side, frame_.x.range.low, frame_.x.range.high);
    const double step = 0.5 * std::abs(curve.x[neighbor] - curve.x[i]);
    return clamped(curve.x[i] + side * (std::isfinite(step) ? step : 0.0), frame_.x.range.low, frame_.x.range.high);
  }

  void band(const Curve& curve) const {
    std::vector<Point> outline;
    for (int side : {1, -1}) {
      for (std::size_t k = 0; k < curve.se.size(); ++k) {
        const std::size_t i = side > 0 ? k : curve.se.size() - 1 - k;
        if (shown(curve, i) && std::isfinite(curve.se[i])) {
          outline.push_back(inside(curve.x[i], curve.y[i] + side * curve.se[i]));
        }
      }
    }
    if (outline.size() > 3) drawing_.band(outline, curve.ink);
  }

  void point(const Curve& curve, std::size_t i) const {
    if (!shown(curve, i)) return;
    const Point center = inside(curve.x[i], curve.y[i]);
    const double se = i < curve.se.size() ? curve.se[i] : 0.0;
    if (std::isfinite(se) && se > 0.0) error_bar(curve, curve.x[i], curve.y[i], se);
    if (off_scale(curve.y[i])) {
      drawing_.mark({center.x, center.y - radius()}, radius(), Mark::arrow_down, curve.ink);
    } else {
      drawing_.mark(center, radius(), curve.shape, curve.ink);
    }
  }

  void error_bar(const Curve& curve, double x, double y, double se) const {
    const Point upper = inside(x, y + se);
    const Point lower = inside(x, y - se);
    const Stroke thin{curve.ink, size_ / 10, false};
    const double cap = 0.3 * size_;
    drawing_.line(upper, lower, thin);
    drawing_.line({upper.x - cap, upper.y}, {upper.x + cap, upper.y}, thin);
    if (!off_scale(y - se)) drawing_.line({lower.x - cap, lower.y}, {lower.x + cap, lower.y}, thin);
  }

  Drawing& drawing_;
  const PlotFrame& frame_;
  double size_;
};

double widest_label(const Drawing& drawing, const Axis& axis, double text_size) {
  double width = 0.0;
  for (const Tick& tick : axis.ticks) width = std::max(width, drawing.text_width(tick.label, {.size = text_size}));
  return width;
}

}  // namespace

Point PlotFrame::at(double x_value, double y_value) const {
  return {area.left + x.position(x_value) * area.width, area.bottom() - y.position(y_value) * area.height};
}

PlotFrame draw_curves(Drawing& drawing, const CurvePlot& plot, const Box& box, double text_size, bool with_legend) {
  const int wanted = static_cast<int>(clamped(box.width / text_size / 5.0, 3.0, 10.0));
  PlotFrame frame{box, x_axis_of(plot, wanted), y_axis_of(plot)};
  const double left = widest_label(drawing, frame.y, text_size) + 0.9 * text_size;
  const double top = (plot.title.empty() && !with_legend ? 2.4 : 4.4) * text_size;
  const double right = 1.4 * text_size;
  const double bottom = 3.3 * text_size;
  frame.area = {box.left + left, box.top + top, box.width - left - right, box.height - top - bottom};
  const CurvePainter painter(drawing, frame, text_size);
  painter.axes(plot, box);
  for (const Curve& curve : plot.curves) painter.curve(curve);
  if (with_legend) painter.legend(plot, box);
  return frame;
}

}  // namespace evenglow::design
