#include "design/engine/step_judgment.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// Two columns of 1 and 3, the same in each of four batches.
Observation striped() {
  const core::CellGrid grid = core::CellGrid::over(8, 4, 0, 0, 8, 4);
  Observation o;
  o.photons = 1000;
  o.luminance = core::Tally(grid.size());
  o.luminance_unit = 25.0;
  o.map = {{grid, 0.0}, {grid, 0.0}};
  for (int b = 0; b < 4; ++b) {
    std::vector<double> batch;
    for (std::size_t i = 0; i < grid.size(); ++i) batch.push_back(i % 2 == 0 ? 0.25 : 0.75);
    o.luminance.add_batch(std::move(batch));
  }
  for (std::size_t i = 0; i < grid.size(); ++i) o.map.luminance.values[i] = i % 2 == 0 ? 25.0 : 75.0;
  o.efficiency = {0.6, 0.01};
  return o;
}

TEST(StepJudgment, TellsAStep) {
  const StepRecord record = make_step_record(3, {core::CellField(striped().map.luminance.grid, 0.2)}, striped(), {});
  EXPECT_EQ(record.step, 3);
  EXPECT_EQ(record.photons, 1000U);
  EXPECT_NEAR(record.rms, 0.5, 1e-12);
  EXPECT_NEAR(record.rms_corrected.value, 0.5, 1e-12);
  EXPECT_NEAR(record.noise, 0.0, 1e-6);
  EXPECT_NEAR(record.luminance_mean, 50.0, 1e-9);
  EXPECT_NEAR(record.mean_density, 0.2, 1e-12);
  EXPECT_EQ(record.efficiency.value, 0.6);
}

TEST(StepJudgment, TellsAFinishedDesignOverItsTarget) {
  DesignSpec spec;
  spec.target.map.nx = 8;
  spec.target.map.ny = 4;
  for (int i = 0; i < 32; ++i) spec.target.map.values.push_back(i % 2 == 0 ? 1.0 : 3.0);
  const FinalJudgment even = make_judgment(striped(), spec);
  EXPECT_NEAR(even.rms_corrected.value, 0.0, 1e-6);
  const FinalJudgment uneven = make_judgment(striped(), {});
  EXPECT_NEAR(uneven.rms_corrected.value, 0.5, 1e-12);
  EXPECT_NEAR(uneven.luminance_mean.value, 50.0, 1e-9);
  EXPECT_EQ(uneven.efficiency.value, 0.6);
}

}  // namespace
}  // namespace evenglow::design
