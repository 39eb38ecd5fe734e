#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/shipped_backlight.h"
#include "tracer/transport/tracer.h"

/// The next-event estimate against counting for the stacks of configs/: 2 x 10^7 photons each, at least 3000 cells. The
/// mean luminances agree within 3 standard errors, and the chi-square per cell is 1 within 0.08 (one sigma: 0.026 at
/// 3000 cells).
namespace evenglow::tests {
namespace {

using namespace tracer;

struct ConfigCase {
  std::string file, variant;
};

void PrintTo(const ConfigCase& config, std::ostream* os) {
  *os << config.file << " " << config.variant;
}

BacklightSpec spec_of(const ConfigCase& config, LuminanceEstimator estimator) {
  BacklightSpec spec = shipped_backlight(config.file + ".yaml", config.variant);
  const core::CellGrid cells = spec.luminance.cells;
  if (cells.size() < 3000) {
    spec.luminance.cells = core::CellGrid::over(64, 48, cells.x0, cells.y0, cells.x0 + cells.nx * cells.dx,
                                                cells.y0 + cells.ny * cells.dy);
  }
  spec.luminance.estimator = estimator;
  spec.color = false;
  return spec;
}

core::Tally luminance_of(const ConfigCase& config, LuminanceEstimator estimator, std::uint64_t seed) {
  BacklightSpec spec = spec_of(config, estimator);
  const DensityField density = initial_density(spec);
  const Scene scene = compile_scene(std::move(spec));
  return trace(scene, density, {.photons = 20'000'000, .batches = 200, .key = {seed, 0, 0}})->luminance;
}

std::string name_of(const testing::TestParamInfo<ConfigCase>& info) {
  return info.param.file + "_" + info.param.variant;
}

class EstimatorConfigsLong : public testing::TestWithParam<ConfigCase> {};

TEST_P(EstimatorConfigsLong, NextEventAgreesWithCounting) {
  const core::Tally next = luminance_of(GetParam(), LuminanceEstimator::kNextEvent, 31);
  const core::Tally count = luminance_of(GetParam(), LuminanceEstimator::kCounting, 32);
  const double sine = std::sin(spec_of(GetParam(), LuminanceEstimator::kCounting).luminance.cone);
  const double per_count = 1.0 / (core::kPi * sine * sine);
  double chi2 = 0.0, variance_next = 0.0, variance_count = 0.0;
  for (std::size_t i = 0; i < next.bins(); ++i) {
    const core::Estimate a = next.total(i), b = count.total(i);
    // Counts are Poisson: each scores `per_count`. Their variance by the other run's value, as that by their own value
    // goes with it: too large a chi-square where cells are dark.
    chi2 += std::pow(a.value - b.value, 2) / (a.se * a.se + per_count * a.value);
    variance_next += a.se * a.se;
    variance_count += b.se * b.se;
  }
  const double cells = static_cast<double>(next.bins());
  const std::vector<double> ones(next.bins(), 1.0);
  const core::Estimate a = next.weighted_total(ones), b = count.weighted_total(ones);
  const double se = std::hypot(a.se, b.se);
  std::printf(
      "z %.2f, chi2/dof %.4f over %.0f cells, relative error of the difference %.5f, variance %.1f times less\n",
      (a.value - b.value) / se, chi2 / cells, cells, se / b.value, variance_count / variance_next);
  EXPECT_GE(cells, 3000.0);
  EXPECT_LT(std::abs(a.value - b.value), 3.0 * se);
  EXPECT_NEAR(chi2 / cells, 1.0, 0.08);
}

INSTANTIATE_TEST_SUITE_P(Configs, EstimatorConfigsLong,
                         testing::Values(ConfigCase{"dbef_vs_lpp", "lpp"}, ConfigCase{"dbef_vs_lpp", "dbef"},
                                         ConfigCase{"dbef_vs_lpp", "dbef_lpp"}, ConfigCase{"tablet_dbef", ""},
                                         ConfigCase{"monitor_two_edges", ""}, ConfigCase{"phone_stack", "dbef_mirror"},
                                         ConfigCase{"phone_stack", "lpp_mirror"},
                                         ConfigCase{"phone_stack", "dbef_white"},
                                         ConfigCase{"phone_stack", "lpp_white"}, ConfigCase{"notebook_stack", ""},
                                         ConfigCase{"monitor_stack", ""}),
                         name_of);

}  // namespace
}  // namespace evenglow::tests
