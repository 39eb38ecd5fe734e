#pragma once

#include <string>

#include <gtest/gtest.h>

#include "design/updaters/updater.h"
#include "tests/support/analytic_backlight.h"

namespace evenglow::tests {

/// An updater that lives on recorded histories proposes what the noise-aware ratio does where it has none. Gives its
/// proposal.
inline design::Proposal expect_noise_aware_ratio_without_records(const std::string& updater) {
  const AnalyticBacklight backlight;
  const design::ForwardModel model = backlight;
  design::DesignState state{{core::CellField(backlight.grid, 0.1)}, {}};
  state.observation = *model(state.density, 100'000, 0);
  const design::DesignSpec spec;
  design::UpdaterMemory memory;
  design::Proposal proposal = design::make_updater(updater)->propose(state, spec, memory);
  EXPECT_EQ(proposal.density.cells.values,
            design::make_updater("ratio_noise_aware")->propose(state, spec, memory).density.cells.values);
  return proposal;
}

}  // namespace evenglow::tests
