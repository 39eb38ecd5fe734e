#include "design/updaters/gradient_updater.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "design/engine/traced_model.h"
#include "tests/design/without_records.h"
#include "tests/support/scenes.h"

namespace evenglow::design {
namespace {

const std::string kPlate =
    "light_guide_plate: {length_mm: 30, width_mm: 15, thickness_mm: 0.6}, microstructure: {cells: [12, 6], density: "
    "0.1, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 3}], reflectors: {bottom: {}, right: "
    "{}, front: {}, back: {}}, films: [{kind: diffuser}], receivers: [{kind: luminance, cells: [12, 6], cone_deg: 30}]";

class GradientBy : public testing::TestWithParam<std::string> {};

/// Judged by a trace with random numbers of its own: the RMS falls by a factor, so it did not fit the noise.
TEST_P(GradientBy, LowersTheRmsOnTheHistoriesOfEachTrace) {
  const tracer::Scene scene = tests::scene_of(kPlate);
  TracedModelOptions options;
  options.batches = 40;
  options.threads = 2;
  const ForwardModel model = traced_model(scene, options);
  DesignSpec spec;
  spec.updater = "gradient";
  spec.gradient = {GetParam(), 25};
  spec.level = 0.1;
  spec.stop_rms = 0.002;
  spec.density_min = 0.005;
  spec.max_steps = 3;
  const DesignLimits limits{100'000, 100'000};
  const DesignProgress progress =
      run_design(model, spec, limits, start_design(initial_density(scene.spec), spec, limits),
                 [](const StepRecord&, const DesignProgress&) {});
  ASSERT_EQ(progress.steps.size(), 4U);
  EXPECT_LT(progress.steps.back().rms_corrected.value, 0.2 * progress.steps.front().rms_corrected.value);
  EXPECT_THAT(progress.steps.front().updater, testing::AnyOf("gradient", "ratio_noise_aware"));
  EXPECT_EQ(progress.steps[1].updater, "gradient");
  EXPECT_THAT(progress.notes.front(), testing::HasSubstr("evaluations"));
  EXPECT_NEAR(progress.best_density.cells.mean(), 0.1, 0.002);
}

INSTANTIATE_TEST_SUITE_P(Methods, GradientBy, testing::Values("lbfgs", "mma"),
                         [](const auto& method) { return method.param; });

TEST(GradientUpdater, IsTheNoiseAwareRatioWithoutRecords) {
  tests::expect_noise_aware_ratio_without_records("gradient");
}

}  // namespace
}  // namespace evenglow::design
