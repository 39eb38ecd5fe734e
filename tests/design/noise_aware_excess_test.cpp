#include <cmath>

#include <gtest/gtest.h>

#include "design/updaters/noise_aware_ratio_updater.h"

namespace evenglow::design {
namespace {

TEST(NoiseAwareExcess, HasNoMeanSoThatTheLevelStays) {
  const core::CellGrid grid = core::CellGrid::over(8, 4, 0, 0, 8, 4);
  DesignState state;
  state.density.cells = {grid, 0.2};
  state.observation.map = {{grid, 0.0}, {grid, 0.0}};
  std::vector<double> batch;
  for (int i = 0; i < 32; ++i) batch.push_back(100.0 * std::exp(0.3 * (i % 8)));
  state.observation.luminance = core::Tally(32);
  state.observation.luminance.add_batch(batch);
  state.observation.luminance.add_batch(batch);
  for (std::size_t i = 0; i < 32; ++i) state.observation.map.luminance.values[i] = 2.0 * batch[i];
  for (std::size_t i = 0; i < 32; ++i) state.density.cells.values[i] = 0.1 + 0.01 * static_cast<double>(i % 5);
  const Denoised excess = noise_aware_excess(state);
  double mean = 0.0;
  for (const double value : excess.field.values) mean += value / 32.0;
  EXPECT_NEAR(mean, 0.0, 1e-12);
  // Without noise nothing is shrunk: it is the logarithm of the luminance itself.
  EXPECT_NEAR(excess.field.values[7] - excess.field.values[0], 0.3 * 7, 1e-9);
}

}  // namespace
}  // namespace evenglow::design
