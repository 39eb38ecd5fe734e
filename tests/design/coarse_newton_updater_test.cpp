#include "design/updaters/coarse_newton_updater.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "design/engine/traced_model.h"
#include "tests/support/analytic_backlight.h"
#include "tests/support/scenes.h"

namespace evenglow::design {
namespace {

CoarseProblem two_nodes() {
  CoarseProblem problem;
  problem.jacobian = (Eigen::MatrixXd(3, 2) << 1.0, 0.5, 0.0, 1.0, 0.0, 0.0).finished();
  problem.ridge = Eigen::VectorXd::Zero(2);
  problem.residual = Eigen::Vector3d(-1.0, -1.0, 5.0);  // the last row cannot be helped
  problem.proposed = Eigen::VectorXd::Zero(2);
  problem.largest_step = 10.0;
  return problem;
}

TEST(CoarseNewton, SolvesTheLeastSquares) {
  const std::vector<double> c = solve(two_nodes());
  EXPECT_NEAR(c[0], 0.5, 1e-6);
  EXPECT_NEAR(c[1], 1.0, 1e-6);
}

TEST(CoarseNewton, LeavesToTheRatioWhatTheTraceCannotTell) {
  CoarseProblem problem = two_nodes();
  problem.ridge << 1e9, 0.0;
  const std::vector<double> c = solve(problem);
  EXPECT_NEAR(c[0], 0.0, 1e-6);
  EXPECT_NEAR(c[1], (1.0 + 0.5) / 1.25, 1e-6);
}

TEST(CoarseNewton, KeepsTheWholeStepInItsBounds) {
  CoarseProblem problem = two_nodes();
  problem.proposed << 0.5, -0.2;
  problem.largest_step = 0.6;
  const std::vector<double> c = solve(problem);
  EXPECT_LE(std::abs(c[0] + 0.5), 0.6 + 1e-9);
  EXPECT_LE(std::abs(c[1] - 0.2), 0.6 + 1e-9);
  EXPECT_NEAR(c[1], 0.8, 1e-6) << "at its bound";
}

/// A thin plate under a film that returns half of the light: cells take it from each other. Judged after the same
/// number of traces, by random numbers of its own.
TEST(CoarseNewton, NeedsFewerTracesThanTheRatioWhereCellsAreCoupled) {
  const tracer::Scene scene = tests::scene_of(
      "light_guide_plate: {length_mm: 40, width_mm: 10, thickness_mm: 0.4}, microstructure: {cells: [24, 4], density: "
      "0.2, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 2, size_mm: [4, 0.3], reflectance: "
      "0.5}], reflectors: {bottom: {}, right: {}, front: {}, back: {}}, films: [{kind: diffuser}, {kind: dbef}], "
      "receivers: [{kind: luminance, cells: [24, 4], cone_deg: 30}]");
  TracedModelOptions options;
  options.batches = 40;
  options.threads = 2;
  options.seed = 3;
  const ForwardModel model = traced_model(scene, options);
  const DesignLimits limits{40'000, 200'000};
  const auto fourth_rms = [&](const std::string& updater) {
    DesignSpec spec;
    spec.updater = updater;
    spec.level = 0.1;
    spec.density_min = 0.002;
    spec.stop_rms = 0.003;
    spec.max_steps = 3;
    spec.coarse_newton = {12, 2};
    const DesignProgress progress =
        run_design(model, spec, limits, start_design(initial_density(scene.spec), spec, limits),
                   [](const StepRecord&, const DesignProgress&) {});
    EXPECT_EQ(progress.steps.size(), 4U);
    return progress.steps.back().rms_corrected.value;
  };
  const double newton = fourth_rms("coarse_newton"), ratio = fourth_rms("ratio_noise_aware");
  EXPECT_LT(newton, 0.7 * ratio);
}

TEST(CoarseNewton, IsTheNoiseAwareRatioWithoutRecords) {
  const tests::AnalyticBacklight backlight;
  const ForwardModel model = backlight;
  DesignState state{{core::CellField(backlight.grid, 0.1)}, {}};
  state.observation = *model(state.density, 100'000, 0);
  DesignSpec spec;
  UpdaterMemory memory;
  const Proposal newton = make_updater("coarse_newton")->propose(state, spec, memory);
  EXPECT_EQ(newton.density.cells.values,
            make_updater("ratio_noise_aware")->propose(state, spec, memory).density.cells.values);
  EXPECT_EQ(newton.method, "ratio_noise_aware");
}

}  // namespace
}  // namespace evenglow::design
