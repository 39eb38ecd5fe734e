#include "design/updaters/history_merit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/engine/design_loop.h"
#include "design/engine/traced_model.h"
#include "tests/support/scenes.h"

namespace evenglow::design {
namespace {

const std::string kPlate =
    "light_guide_plate: {length_mm: 30, width_mm: 15, thickness_mm: 0.6}, microstructure: {cells: [12, 6], density: "
    "0.1, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 3}], reflectors: {bottom: {}, right: "
    "{}}, films: [{kind: diffuser}], receivers: [{kind: luminance, cells: [12, 6], cone_deg: 30}]";

class HistoryMeritOf : public testing::TestWithParam<std::size_t> {
 protected:
  HistoryMeritOf() : scene_(tests::scene_of(kPlate)), state_{initial_density(scene_.spec), {}} {
    TracedModelOptions options;
    options.batches = 40;
    options.threads = 2;
    options.record_bytes = GetParam();
    state_.observation = *traced_model(scene_, options).recording(state_.density, 20'000, 0);
    state_.recorded = {{state_.observation.records, state_.observation.luminance, state_.observation.photons}};
    spec_.target.kind = "center_weighted";
  }

  tracer::Scene scene_;
  DesignState state_;
  DesignSpec spec_;
};

TEST_P(HistoryMeritOf, IsTheSquaredRmsWithItsNoise) {
  const HistoryMerit::Value value = HistoryMerit(state_, spec_).at(state_.density);
  const StepRecord record = make_step_record(0, state_.density, state_.observation, spec_);
  EXPECT_NEAR(value.merit, record.rms * record.rms, 1e-5);
  EXPECT_NEAR(value.effective_share, 1.0, 1e-9);
}

/// The same histories on both sides: no noise.
TEST_P(HistoryMeritOf, HasTheGradientOfItsDifferences) {
  spec_.mask = {2, 1, {1.0, 0.0}};
  const HistoryMerit merit(state_, spec_);
  tracer::DensityField there = state_.density;
  for (std::size_t i = 0; i < there.cells.values.size(); ++i)
    there.cells.values[i] *= 1.1 + 0.1 * std::sin(static_cast<double>(i));
  const core::CellField gradient = merit.at(there).gradient;
  double largest = 0.0;
  for (const double value : gradient.values) largest = std::max(largest, std::abs(value));
  for (std::size_t i = 0; i < there.cells.values.size(); i += 7) {
    constexpr double kStep = 1e-4;
    tracer::DensityField more = there, less = there;
    more.cells.values[i] *= std::exp(kStep);
    less.cells.values[i] *= std::exp(-kStep);
    const double expected = (merit.at(more).merit - merit.at(less).merit) / (2.0 * kStep);
    EXPECT_NEAR(gradient.values[i], expected, 1e-4 * largest) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(AllRecordedAndSome, HistoryMeritOf,
                         testing::Values(std::size_t{64} << 20, std::size_t{2} << 20));

}  // namespace
}  // namespace evenglow::design
