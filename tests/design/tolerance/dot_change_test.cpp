#include "design/tolerance/dot_change.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "design/tolerance/distribution.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::design {
namespace {

core::PhotonRng rng_of(std::uint64_t index) {
  return {{99, 0, 0}, index};
}

DotModel model_of(const core::CellField& density, double diameter, core::Footprint footprint = core::Footprint::round) {
  DotModel model{footprint, density, 1.0};
  model.diameter.values.assign(density.values.size(), diameter);
  return model;
}

core::CellField changed(const core::CellField& density, const DotModel& model, double growth, double size, double place,
                        std::uint64_t index) {
  core::PhotonRng a = rng_of(2 * index), b = rng_of(2 * index + 1);
  return changed_density(density, model, {core::CellField(density.grid, growth), size, place}, a, b);
}

const core::CellGrid kGrid = core::CellGrid::over(4, 3, 0.0, 0.0, 4.0, 3.0);

TEST(DotChange, GrowthScalesTheAreaAndIsClipped) {
  core::CellField density(kGrid, 0.2);
  density.values[3] = 0.9;
  const auto grown = changed(density, model_of(density, 0.06), 0.006, 0.0, 0.0, 0);
  EXPECT_NEAR(grown.values[0], 0.2 * 1.21, 1e-12);
  EXPECT_EQ(grown.values[3], 1.0);
  const auto gone = changed(density, model_of(density, 0.06), -0.07, 0.0, 0.0, 0);
  EXPECT_EQ(gone.max(), 0.0);
}

/// Against the dots themselves: cells with a fixed number of dots whose diameters scatter.
TEST(DotChange, SizesScatterTheCellsAsRealDotsDo) {
  const core::CellGrid one = core::CellGrid::over(1, 1, 0.0, 0.0, 1.0, 1.0);
  constexpr double d = 0.06, g = 0.004, s = 0.012;
  constexpr int kDots = 60, kTrials = 20000;
  const core::CellField density(one, kDots * core::footprint_area(core::Footprint::round, d));
  double sum[2] = {}, squares[2] = {};
  for (int t = 0; t < kTrials; ++t) {
    core::PhotonRng rng = rng_of(static_cast<std::uint64_t>(t) + 1000000);
    double real = 0.0;
    for (int i = 0; i < kDots; ++i) real += core::footprint_area(core::Footprint::round, d + g + s * draw_normal(rng));
    const double modeled = changed(density, model_of(density, d), g, s, 0.0, static_cast<std::uint64_t>(t)).values[0];
    for (int k = 0; k < 2; ++k) {
      const double value = (k == 0 ? real : modeled) - density.values[0];
      sum[k] += value;
      squares[k] += value * value;
    }
  }
  double variance[2];
  for (int k = 0; k < 2; ++k) variance[k] = squares[k] / kTrials - sum[k] * sum[k] / kTrials / kTrials;
  const double limit = tests::z_limit(1e-3, 2);
  EXPECT_LT(std::abs(sum[0] - sum[1]) / std::sqrt(kTrials * (variance[0] + variance[1])), limit);
  EXPECT_LT(std::abs(variance[0] - variance[1]) / variance[0] / std::sqrt(4.0 / kTrials), limit);
}

/// Area of squares beyond a line, their places fixed, with shifts drawn anew each time: the variance is that of
/// `exchange` for each dot in a unit of area and mm of line.
TEST(DotChange, PlacesExchangeAreaAsRealDotsDo) {
  constexpr double side = 0.06, reach = 0.4;
  constexpr int kDots = 4000, kTrials = 4000;
  const double per_mm = kDots / (2.0 * reach);  // dots for each mm across the line, on 1 mm of it
  core::PhotonRng places = rng_of(5);
  std::vector<double> x(kDots);
  for (int i = 0; i < kDots; ++i) x[static_cast<std::size_t>(i)] = reach * (2.0 * (i + places.uniform()) / kDots - 1.0);
  for (const double spread : {0.005, 0.03, 0.06}) {
    double sum = 0.0, squares = 0.0;
    for (int t = 0; t < kTrials; ++t) {
      core::PhotonRng rng = rng_of(static_cast<std::uint64_t>(t) + 77);
      double beyond = 0.0;
      for (const double at : x) beyond += side * std::clamp(at + spread * draw_normal(rng) + 0.5 * side, 0.0, side);
      sum += beyond;
      squares += (beyond - 0.5 * kDots * side * side) * (beyond - 0.5 * kDots * side * side);
    }
    const double off = sum / kTrials - 0.5 * kDots * side * side;
    const double variance = squares / kTrials - off * off;
    const double expected = per_mm * exchange(core::Footprint::square, side, spread);
    EXPECT_LT(std::abs(variance / expected - 1.0) / std::sqrt(2.0 / kTrials), tests::z_limit(1e-3, 3)) << spread;
  }
}

/// Points: half the mean distance of two shifts, spread / sqrt(pi). Small shifts of a disc: spread^2 times the integral
/// of its squared chord, 16 r^3 / 3.
TEST(DotChange, ExchangeHasItsLimits) {
  const double r = 0.03, area = core::footprint_area(core::Footprint::round, 2.0 * r);
  const double far = 50.0;  // the dot is a point beside it
  EXPECT_NEAR(exchange(core::Footprint::round, 2.0 * r, far) / (area * area), far / std::sqrt(std::acos(-1.0)), 0.02);
  EXPECT_NEAR(exchange(core::Footprint::round, 2.0 * r, 1e-5) / 1e-10, 16.0 * r * r * r / 3.0, 2e-8);
  EXPECT_EQ(exchange(core::Footprint::round, 2.0 * r, 0.0), 0.0);
}

TEST(DotChange, PlacesKeepTheAreaInAll) {
  const core::CellField density(kGrid, 0.3);
  const auto moved = changed(density, model_of(density, 0.06), 0.0, 0.0, 0.1, 3);
  EXPECT_NE(moved.values, density.values);
  EXPECT_NEAR(moved.mean(), density.mean(), 1e-12);
}

TEST(DotChange, DiametersFollowTheMode) {
  core::CellField density(kGrid, 0.1);
  density.values[0] = 0.4;
  DotSpec spec;
  EXPECT_EQ(dot_model(density, 1.0, spec).diameter.values[0], spec.diameter);
  spec.mode = DotMode::lattice;
  spec.pitch = 0.12;
  spec.diameter_min = 0.01;
  spec.diameter_max = 0.12;
  EXPECT_NEAR(core::footprint_area(spec.footprint, dot_model(density, 1.0, spec).diameter.values[1]), 0.1 * 0.12 * 0.12,
              1e-9);
  spec.mode = DotMode::both;
  const DotModel both = dot_model(density, 1.0, spec);
  EXPECT_GT(both.diameter.values[0], both.diameter.values[1]);
}

}  // namespace
}  // namespace evenglow::design
