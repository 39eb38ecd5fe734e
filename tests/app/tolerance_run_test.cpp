#include "app/tolerance_run.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/tolerance/figures.h"

/// The state of a run; the run itself is tested in tolerance_test.cpp.
namespace evenglow::app {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(2, 2, 0.0, 0.0, 1.0, 1.0);

design::ToleranceSamples samples() {
  design::ToleranceSamples run;
  run.reference.assign(design::kFigures.size(), {0.1, 0.01});

  for (int i = 0; i < 3; ++i) {
    run.samples.push_back({{0.1 * i, 1.0 / 3.0},
                           std::vector<core::Estimate>(design::kFigures.size(), {1.0 / 7.0, 1.0 * i}),
                           {{1.0 / 9.0, 0.5}, {0.25, 1.0 / 11.0}}});
    tracer::LuminanceMap map{core::CellField(kGrid, 100.0 / 3.0 + i), core::CellField(kGrid, 0.1)};
    run.maps.add(map);
  }
  return run;
}

TEST(ToleranceRun, StateComesBackToTheBit) {
  const design::ToleranceSamples run = samples();
  const std::string text = tolerance_state("me", run);
  const design::ToleranceSamples back = read_tolerance_state(text, "me", kGrid);
  EXPECT_EQ(tolerance_state("me", back), text);
  EXPECT_EQ(back.samples[2].parameters, run.samples[2].parameters);
  EXPECT_EQ(back.samples[1].halves.thirteen[1], 1.0 / 11.0);
  EXPECT_EQ(back.maps.maps(false).mean.values, run.maps.maps(false).mean.values);
}

TEST(ToleranceRun, StateOfAnotherRunIsRefused) {
  const std::string text = tolerance_state("me", samples());
  EXPECT_THROW(read_tolerance_state(text, "you", kGrid), core::Error);
  EXPECT_THROW(read_tolerance_state(text, "me", core::CellGrid::over(3, 2, 0, 0, 1, 1)), core::Error);
}

}  // namespace
}  // namespace evenglow::app
