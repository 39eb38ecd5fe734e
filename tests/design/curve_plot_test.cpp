#include "design/report/curve_plot.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "design/report/svg_drawing.h"

namespace evenglow::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Notes where marks stand; all points must be finite.
class Notebook final : public Drawing {
 public:
  void polyline(std::span<const Point> points, const Stroke& /*stroke*/) override {
    for (const Point& p : points) check(p);
  }
  void band(std::span<const Point> outline, Ink /*ink*/) override {
    for (const Point& p : outline) check(p);
  }
  void mark(Point center, double /*radius*/, Mark shape, Ink /*ink*/) override {
    check(center);
    shapes.push_back(shape);
  }
  void text(Point at, std::string_view /*text*/, const TextStyle& /*style*/) override { check(at); }
  double text_width(std::string_view text, const TextStyle& style) const override {
    return 0.6 * style.size * static_cast<double>(text.size());
  }
  std::vector<Mark> shapes;

 private:
  static void check(Point p) {
    EXPECT_TRUE(std::isfinite(p.x) && p.x >= 0.0 && p.x <= 400.0) << p.x;
    EXPECT_TRUE(std::isfinite(p.y) && p.y >= 0.0 && p.y <= 300.0) << p.y;
  }
};

TEST(CurvePlot, ValuesOffALogarithmicAxisBecomeArrows) {
  CurvePlot plot{"t", "x", "y", true, true, false, {}};
  plot.curves.push_back({"c", Ink::series_1, {0, 1, 2, 3}, {10, -1, nan, 0}, {1, 3, nan, 0}});
  Notebook notebook;
  draw_curves(notebook, plot, {0, 0, 400, 300}, 12.0, false);
  EXPECT_EQ(notebook.shapes, (std::vector<Mark>{Mark::disc, Mark::arrow_down, Mark::arrow_down}));
}

TEST(CurvePlot, StaysInTheBoxWhateverTheValues) {
  const double huge = std::numeric_limits<double>::max() / 1e10;
  for (const std::vector<double>& y : {std::vector<double>{}, {nan}, {0}, {5}, {-2, -2}, {1e-300, 1}, {huge, -huge}}) {
    for (const bool log : {false, true}) {
      CurvePlot plot{"t", "x", "y", log, false, false, {}};
      Curve curve{"c", Ink::series_1, {}, y, std::vector<double>(y.size(), 0.5), y.size() < 2};
      for (std::size_t i = 0; i < y.size(); ++i) curve.x.push_back(static_cast<double>(i));
      plot.curves.push_back(curve);
      Notebook notebook;
      draw_curves(notebook, plot, {0, 0, 400, 300}, 10.0, true);
    }
  }
}

TEST(CurvePlot, AxisFromZeroGivesNoRoomToErrorBarsBelow) {
  CurvePlot plot{"", "", "", false, false, true, {}};
  plot.curves.push_back({"c", Ink::series_1, {0, 1}, {0.0, 100.0}, {5.0, 5.0}});
  EXPECT_EQ(y_axis_of(plot).range.low, 0.0);
  EXPECT_GE(y_axis_of(plot).range.high, 105.0);
}

TEST(SvgDrawing, EscapesTextAndLabels) {
  SvgDrawing svg(100, 50);
  svg.text({1, 2}, "<b>&", {});
  const std::string element = svg.element("\"><script>");
  EXPECT_NE(element.find("&lt;b&gt;&amp;</text>"), std::string::npos);
  EXPECT_NE(element.find("aria-label=\"&quot;&gt;&lt;script&gt;\""), std::string::npos);
}

/// Keeps the corners of the last line.
class LastLine final : public Drawing {
 public:
  void polyline(std::span<const Point> points, const Stroke& /*stroke*/) override {
    corners.assign(points.begin(), points.end());
  }
  void band(std::span<const Point> /*outline*/, Ink /*ink*/) override {}
  void mark(Point /*center*/, double /*radius*/, Mark /*shape*/, Ink /*ink*/) override {}
  void text(Point /*at*/, std::string_view /*text*/, const TextStyle& /*style*/) override {}
  double text_width(std::string_view /*text*/, const TextStyle& /*style*/) const override { return 10.0; }
  std::vector<Point> corners;
};

TEST(CurvePlot, AHistogramStepsHalfwayBetweenItsPoints) {
  Curve curve;
  curve.x = {1, 2, 3};
  curve.y = {5, 9, 7};
  curve.marked = false;
  curve.stepped = true;
  CurvePlot plot{"t", "x", "y", false, false, true, {curve}};
  LastLine line;
  const PlotFrame frame = draw_curves(line, plot, {0, 0, 400, 300}, 12.0, false);
  EXPECT_EQ(frame.x.range.low, 0.5);
  EXPECT_EQ(frame.x.range.high, 3.5);
  ASSERT_EQ(line.corners.size(), 6U);
  const double borders[] = {0.5, 1.5, 1.5, 2.5, 2.5, 3.5};
  for (std::size_t i = 0; i < 6; ++i) {
    EXPECT_NEAR(line.corners[i].x, frame.at(borders[i], 0.0).x, 1e-9) << i;
    EXPECT_NEAR(line.corners[i].y, frame.at(0.0, curve.y[i / 2]).y, 1e-9) << i;
  }
  plot.curves[0].x = {1, nan, 3};
  draw_curves(line, plot, {0, 0, 400, 300}, 12.0, false);
  for (const Point& corner : line.corners) EXPECT_TRUE(std::isfinite(corner.x));
}

}  // namespace
}  // namespace evenglow::design
