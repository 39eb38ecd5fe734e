#include "design/engine/design_start.h"

#include <gtest/gtest.h>

#include "core/config/config_node.h"

namespace evenglow::design {
namespace {

tracer::BacklightSpec backlight(const std::string& sources) {
  auto document = core::ConfigDocument::parse(
      "light_guide_plate: {length_mm: 60, width_mm: 30, thickness_mm: 0.6}\n"
      "microstructure: {cells: [30, 16], density: 0.06}\n"
      "sources: " +
          sources +
          "\n"
          "reflectors: {bottom: {kind: white}, left: {kind: white}, right: {kind: white}, front: {kind: white}, "
          "back: {kind: white}}\n"
          "films: [{kind: diffuser}]\n",
      "run.yaml");
  auto spec = tracer::read_backlight(document.root());
  document.finish();
  return spec;
}

DesignSpec start(const std::string& kind) {
  DesignSpec spec;
  spec.start.kind = kind;
  return spec;
}

TEST(DesignStart, FlatIsWhatTheMicrostructureSays) {
  const auto density = first_density(backlight("[{kind: led_row, count: 4, pitch_mm: 7}]"), start("flat"));
  for (const double value : density.cells.values) EXPECT_EQ(value, 0.06);
}

/// Mean of a column or a row of cells, over LEDs and the gaps between them.
double column(const tracer::DensityField& d, int ix) {
  double sum = 0.0;
  for (int iy = 0; iy < 16; ++iy) sum += d.cells.values[static_cast<std::size_t>(iy * 30 + ix)] / 16.0;
  return sum;
}
double row(const tracer::DensityField& d, int iy) {
  double sum = 0.0;
  for (int ix = 0; ix < 30; ++ix) sum += d.cells.values[static_cast<std::size_t>(iy * 30 + ix)] / 30.0;
  return sum;
}

TEST(DesignStart, AnalyticIsLowestTowardsTheLedsOfEveryEdge) {
  // Dense rows of LEDs: what is left is the way along the plate.
  const auto left = first_density(backlight("[{kind: led_row, count: 10, pitch_mm: 2.8}]"), start("analytic"));
  EXPECT_NEAR(left.cells.mean(), 0.06, 0.002);
  for (int ix = 4; ix < 26; ++ix) EXPECT_LT(column(left, ix), column(left, ix + 2)) << ix;
  const auto two = first_density(
      backlight("[{kind: led_row, count: 10, pitch_mm: 2.8}, {kind: led_row, edge: right, count: 10, pitch_mm: 2.8}]"),
      start("analytic"));
  EXPECT_LT(column(two, 5), column(two, 15));
  EXPECT_NEAR(column(two, 5), column(two, 24), 0.02 * column(two, 5));
  const auto front =
      first_density(backlight("[{kind: led_row, edge: front, count: 20, pitch_mm: 2.8}]"), start("analytic"));
  EXPECT_LT(row(front, 4), row(front, 12));
}

TEST(DesignStart, AnalyticTakesTheLevelOfTheSpec) {
  DesignSpec spec = start("analytic");
  spec.level = 0.03;
  const auto density = first_density(backlight("[{kind: led_row, count: 4, pitch_mm: 7}]"), spec);
  EXPECT_NEAR(density.cells.mean(), 0.03, 0.001);
}

TEST(DesignStart, MapOfOtherCellsIsResampled) {
  DesignSpec spec = start("map");
  spec.start.map = {2, 1, {0.02, 0.1}};
  const auto density = first_density(backlight("[{kind: led_row, count: 4, pitch_mm: 7}]"), spec);
  EXPECT_EQ(density.cells.grid.nx, 30);
  EXPECT_NEAR(density.cells.at(1, 5), 0.02, 1e-12);
  EXPECT_NEAR(density.cells.at(59, 5), 0.1, 1e-12);
  EXPECT_NEAR(density.cells.mean(), 0.06, 1e-3);
}

TEST(DesignStart, KeepsTheLimits) {
  DesignSpec spec = start("map");
  spec.start.map = {2, 1, {0.0, 1.0}};
  const auto density = first_density(backlight("[{kind: led_row, count: 4, pitch_mm: 7}]"), spec);
  EXPECT_EQ(density.cells.min(), spec.density_min);
  EXPECT_EQ(density.cells.max(), spec.density_max);
}

}  // namespace
}  // namespace evenglow::design
