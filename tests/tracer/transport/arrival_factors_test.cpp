#include "tracer/transport/arrival_factors.h"

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

TEST(ArrivalFactors, AreTheRatiosOfTheChances) {
  const core::CellGrid grid = core::CellGrid::over(3, 1, 0.0, 0.0, 3.0, 1.0);
  DensityField traced{core::CellField(grid, 0.0)}, wanted = traced;
  traced.cells.values = {0.2, 0.0, 1.0};
  wanted.cells.values = {0.3, 0.5, 0.5};
  const ArrivalFactors factors(traced, wanted);
  EXPECT_NEAR(factors.met[0], 1.5, 1e-15);
  EXPECT_NEAR(factors.passed[0], 0.7 / 0.8, 1e-15);
  EXPECT_NEAR(factors.slope_passed[0], -0.3 / 0.7, 1e-15);
  EXPECT_EQ(factors.met[1], 1.0) << "never seen";
  EXPECT_EQ(factors.passed[2], 1.0) << "never seen";
}

TEST(ArrivalFactors, RefuseOtherCells) {
  const DensityField one{core::CellField(core::CellGrid{}, 0.1)};
  EXPECT_THROW(ArrivalFactors(one, {core::CellField(core::CellGrid::over(2, 1, 0, 0, 1, 1), 0.1)}), core::Error);
}

}  // namespace
}  // namespace evenglow::tracer
