#include "design/updaters/auto_updater.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "tests/support/coupled_backlight.h"

namespace evenglow::design {
namespace {

DesignProgress designed(const tests::CoupledBacklight& model) {
  DesignSpec spec;
  spec.updater = "auto";
  spec.stop_rms = 0.005;
  spec.density_min = 1e-4;
  spec.density_max = 0.95;
  spec.level = 0.1;
  spec.max_steps = 40;
  const DesignLimits limits{100000, 16000000};
  const ForwardModel forward = model;
  return run_design(forward, spec, limits, start_design({core::CellField(model.grid, 0.1)}, spec, limits),
                    [](const StepRecord&, const DesignProgress&) {});
}

TEST(AutoUpdater, StaysWithTheRatioWhereCellsAreIndependent) {
  tests::CoupledBacklight model;
  model.diffusion = 400.0;  // light is even all over the plate: each cell gives what its own density says
  const DesignProgress progress = designed(model);
  EXPECT_EQ(progress.stop_reason.rfind("reached", 0), 0U);
  EXPECT_TRUE(progress.notes.empty()) << progress.notes.front();
  for (const StepRecord& record : progress.steps) EXPECT_EQ(record.updater, "ratio_noise_aware");
}

TEST(AutoUpdater, AcceleratesWhereCellsAreCoupledAndSaysSo) {
  tests::CoupledBacklight model;
  model.out = 10.0;
  model.diffusion = 20.0;
  model.noise = 1e-3;
  const DesignProgress progress = designed(model);
  EXPECT_EQ(progress.stop_reason.rfind("reached", 0), 0U) << progress.stop_reason;
  ASSERT_FALSE(progress.notes.empty());
  EXPECT_THAT(progress.notes.front(), testing::HasSubstr("the cells are coupled, on with anderson"));
  EXPECT_EQ(progress.steps.front().updater, "ratio_noise_aware");
  EXPECT_LT(model.true_rms(progress.best_density.cells), 0.006);
}

}  // namespace
}  // namespace evenglow::design
