#include "tracer/polarized_bsdf/lobe_problem.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

std::vector<LobeReading> readings(const LobeFitOptions& options) {
  return lobe_readings(
      LuminanceTable::read(tests::data_file("dbef_reflection_luminance.csv"), ScatterKind::reflection),
      LuminanceTable::read(tests::data_file("dbef_transmission_luminance.csv"), ScatterKind::transmission), options);
}

TEST(LobeProblem, ErrorsAreRelativePlusAbsolute) {
  LobeFitOptions options;
  options.relative_error = 0.1;
  options.absolute_error = 0.05;
  for (const LobeReading& r : readings(options)) EXPECT_NEAR(r.error, 0.1 * r.row.measured + 0.05, 1e-12);
}

TEST(LobeProblem, FreeParametersKeepTheEnergy) {
  const LobeFitOptions options;
  const LobeFree x = lobe_start(readings(options), options);
  const LobeValues<double> v = lobe_values(x.data(), 0.015);
  // Whatever the logarithms, a1 and b1 make R + T = 1 - absorption: another e0 changes them in proportion.
  LobeFree brighter = x;
  brighter[16] += std::log(2.0);  // e0
  const LobeValues<double> w = lobe_values(brighter.data(), 0.015);
  EXPECT_NEAR(w.e0 / v.e0, 2.0, 1e-12);
  EXPECT_GT(w.a1, 2.0 * v.a1 * 0.999);
  EXPECT_GT(w.b1, 2.0 * v.b1 * 0.999);
}

TEST(LobeProblem, TheJacobianIsThatOfFiniteDifferences) {
  LobeFitOptions options;
  options.loss_width = 0.0;
  const auto all = readings(options);
  const LobeSolution solution = solve_lobes(all, lobe_start(all, options), options);
  ASSERT_TRUE(solution.converged);
  constexpr double kStep = 1e-5;
  for (const std::size_t i : {0u, 40u, 100u}) {
    const auto residual = [&](const LobeFree& x) {
      return lobe_luminance(lobe_values(x.data(), options.absorption), all[i].kind, all[i].row) / all[i].error;
    };
    for (int j = 0; j < kLobeFree; ++j) {
      LobeFree up = solution.x, down = solution.x;
      up[static_cast<std::size_t>(j)] += kStep;
      down[static_cast<std::size_t>(j)] -= kStep;
      const double slope = (residual(up) - residual(down)) / (2.0 * kStep);
      EXPECT_NEAR(solution.jacobian(static_cast<Eigen::Index>(i), j), slope, 1e-4 * (1.0 + std::abs(slope)))
          << i << ' ' << j;
    }
  }
}

}  // namespace
}  // namespace evenglow::tracer
