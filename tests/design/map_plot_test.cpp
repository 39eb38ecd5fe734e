#include "design/report/map_plot.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

void expect_color(const Rgb& seen, const Rgb& wanted) {
  EXPECT_EQ(seen.hex(), wanted.hex());
}

TEST(MapPlot, FrontLeftCellStandsAtTheLowerLeft) {
  core::CellField field({2, 2, 0.0, 0.0, 10.0, 10.0}, 0.5);
  field.values = {0.0, 0.5, 1.0, 0.5};  // front left is 0, back left is 1
  CairoDrawing drawing(600, 600);
  const ColorMap& colors = ColorMap::luminance();
  const Box area = draw_map(drawing, {"t", "c", &field, {0.0, 1.0}, &colors}, {0, 0, 600, 600}, 12.0);
  const int left = static_cast<int>(area.left + 0.25 * area.width);
  expect_color(drawing.pixel(left, static_cast<int>(area.bottom() - 0.25 * area.height)), colors.at(0.0));
  expect_color(drawing.pixel(left, static_cast<int>(area.top + 0.25 * area.height)), colors.at(1.0));
}

TEST(MapPlot, KeepsTheProportionsOfThePanel) {
  const core::CellField wide({8, 2, 0.0, 0.0, 10.0, 10.0}, 1.0);
  const core::CellField high({2, 8, 0.0, 0.0, 10.0, 10.0}, 1.0);
  CairoDrawing drawing(600, 400);
  for (const auto& [field, ratio] : {std::pair{&wide, 4.0}, std::pair{&high, 0.25}}) {
    const Box area = draw_map(drawing, {"", "", field, {0.0, 2.0}, &ColorMap::density()}, {0, 0, 600, 400}, 12.0);
    EXPECT_NEAR(area.width / area.height, ratio, 1e-9);
    EXPECT_LT(area.right(), 600.0);
    EXPECT_LT(area.bottom(), 400.0);
  }
}

TEST(ColorMaps, RiseInLightnessWithoutAStepInColor) {
  for (const ColorMap* map : {&ColorMap::luminance(), &ColorMap::density()}) {
    const auto luma = [](const Rgb& c) { return 0.2126 * c.red + 0.7152 * c.green + 0.0722 * c.blue; };
    for (int i = 1; i < 256; ++i) {
      const Rgb a = map->at((i - 1) / 255.0);
      const Rgb b = map->at(i / 255.0);
      EXPECT_GT(luma(b), luma(a));
      EXPECT_LT(std::max({std::abs(b.red - a.red), std::abs(b.green - a.green), std::abs(b.blue - a.blue)}), 0.02);
    }
    EXPECT_EQ(map->hex().size(), 256U * 6U);
  }
}

}  // namespace
}  // namespace evenglow::design
