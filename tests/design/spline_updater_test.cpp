#include "design/updaters/spline_updater.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "tests/support/coupled_backlight.h"

namespace evenglow::design {
namespace {

TEST(SplineField, IsAPartitionOfUnityAndReproducesLines) {
  const core::CellGrid grid = core::CellGrid::over(50, 20, 0, 0, 50, 20);
  for (const auto& [nx, ny] : {std::pair{1, 2}, {2, 1}, {4, 3}, {7, 5}}) {
    const core::CellField one = spline_field(grid, nx, ny, std::vector<double>(static_cast<std::size_t>(nx * ny), 1.0));
    for (const double value : one.values) ASSERT_NEAR(value, 1.0, 1e-12) << nx << " " << ny;
  }
  const core::CellField line = spline_field(grid, 2, 1, {1.0, 3.0});
  for (int ix = 0; ix < 50; ++ix)
    EXPECT_NEAR(line.values[static_cast<std::size_t>(ix)], 1.0 + 2.0 * (ix + 0.5) / 50, 1e-12);
}

TEST(SplineField, OneCoefficientIsLocal) {
  const core::CellGrid grid = core::CellGrid::over(80, 1, 0, 0, 80, 1);
  std::vector<double> c(8, 0.0);
  c[1] = 1.0;  // of five spans the first two
  const core::CellField field = spline_field(grid, 8, 1, c);
  EXPECT_GT(field.values[5], 0.3);
  for (std::size_t i = 33; i < 80; ++i) EXPECT_EQ(field.values[i], 0.0);
}

/// Each method on a smooth problem of two coefficients: down from 15 % to what a straight line in ln density can do.
class SplineUpdater : public testing::TestWithParam<std::string> {};

TEST_P(SplineUpdater, FindsASmoothProfile) {
  tests::CoupledBacklight model;
  model.out = 2.0;
  model.diffusion = 120.0;
  model.noise = 1e-4;
  DesignSpec spec;
  spec.updater = "spline";
  spec.spline = {2, 1, GetParam()};
  spec.stop_rms = 0.001;
  spec.density_min = 1e-4;
  spec.level = 0.1;
  spec.max_steps = 40;
  const DesignLimits limits{1000000, 1000000};
  const ForwardModel forward = model;
  const core::CellField flat(model.grid, 0.1);
  ASSERT_GT(model.true_rms(flat), 0.1);
  const DesignProgress progress =
      run_design(forward, spec, limits, start_design({flat}, spec, limits), [](const auto&, const auto&) {});
  EXPECT_LT(model.true_rms(progress.best_density.cells), 0.4 * model.true_rms(flat));
  // Within the family: ln density is a straight line along x.
  const auto& d = progress.best_density.cells.values;
  EXPECT_NEAR(std::log(d[10] / d[0]), std::log(d[30] / d[20]), 1e-9);
}
INSTANTIATE_TEST_SUITE_P(Methods, SplineUpdater, testing::Values("bobyqa", "cobyla", "sbplx"),
                         [](const auto& name) { return name.param; });

}  // namespace
}  // namespace evenglow::design
