#include "design/updaters/coarse_newton_updater.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/engine/traced_model.h"
#include "design/updaters/coarse_basis.h"
#include "tests/design/without_records.h"
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

/// RMS of the means of blocks of the display over their mean.
double block_rms(const core::CellField& luminance, const CoarseBasis& basis) {
  const std::vector<std::uint32_t> block = basis.nearest_node(luminance.grid);
  std::vector<double> sums(basis.count(), 0.0), cells(basis.count(), 0.0);
  for (std::size_t i = 0; i < block.size(); ++i) {
    sums[block[i]] += luminance.values[i];
    ++cells[block[i]];
  }
  double squares = 0.0;
  for (std::size_t b = 0; b < sums.size(); ++b)
    squares += std::pow(sums[b] / cells[b] / luminance.mean() - 1.0, 2) / static_cast<double>(sums.size());
  return std::sqrt(squares);
}

/// A thin plate under a film that returns half of the light: cells take it from each other. What the grid of nodes can
/// see falls further in a step than by the ratio. Judged by random numbers of its own.
TEST(CoarseNewton, SolvesWhatIsCoarseInOneStep) {
  const tracer::Scene scene = tests::scene_of(
      "light_guide_plate: {length_mm: 40, width_mm: 12, thickness_mm: 0.3}, microstructure: {cells: [24, 4], density: "
      "0.2, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 4, size_mm: [2.8, 0.25], "
      "reflectance: "
      "0.5}], reflectors: {bottom: {}, right: {}, front: {}, back: {}}, films: [{kind: diffuser}, {kind: dbef}], "
      "receivers: [{kind: luminance, cells: [24, 4], cone_deg: 30}]");
  TracedModelOptions options;
  options.batches = 40;
  options.threads = 2;
  const ForwardModel model = traced_model(scene, options);
  DesignSpec spec;
  spec.density_min = 1e-3;
  spec.level = 0.2;
  spec.coarse_newton = {6, 2};
  constexpr std::uint64_t kPhotons = 200'000;
  DesignState state{initial_density(scene.spec), {}};
  UpdaterMemory memory;
  for (std::uint32_t step = 0; step < 3; ++step) {  // to where the map is close to linear
    state.observation = *model(state.density, kPhotons, step);
    state.density = make_updater("ratio_noise_aware")->propose(state, spec, memory).density;
  }
  state.observation = *model.recording(state.density, kPhotons, 3);
  state.recorded = {{state.observation.records, state.observation.luminance, state.observation.photons, 3}};
  const CoarseBasis basis(state.density.cells.grid, 6, 2);
  const auto after = [&](const std::string& updater) {
    const Proposal proposal = make_updater(updater)->propose(state, spec, memory);
    EXPECT_EQ(proposal.method.empty() ? updater : proposal.method, updater);
    return block_rms(model(proposal.density, kPhotons, 4)->map.luminance, basis);
  };
  const double before = block_rms(state.observation.map.luminance, basis);
  const double newton = after("coarse_newton"), ratio = after("ratio_noise_aware");
  EXPECT_GT(before, 0.05) << newton << " " << ratio;
  EXPECT_LT(newton, 0.6 * ratio) << before;
}

TEST(CoarseNewton, IsTheNoiseAwareRatioWithoutRecords) {
  EXPECT_EQ(tests::expect_noise_aware_ratio_without_records("coarse_newton").method, "ratio_noise_aware");
}

}  // namespace
}  // namespace evenglow::design
