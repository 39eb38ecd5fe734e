#include "design/engine/traced_model.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// Photons that are lost at random have a standard error of their own root: it must not excuse them.
TEST(EnergyAccount, ExcusesNoLossWhereAllPhotonsCarryTheSameFlux) {
  const std::uint64_t sent = 1'000'000;
  for (const double lost : {1.0, 10.0, 100.0}) {
    const core::Estimate sum{static_cast<double>(sent) - lost, std::sqrt(lost)};
    EXPECT_FALSE(energy_adds_up(sum, sent, false)) << lost;
    EXPECT_FALSE(energy_adds_up({static_cast<double>(sent) + lost, std::sqrt(lost)}, sent, false)) << lost;
  }
  EXPECT_TRUE(energy_adds_up({1e6 + 1e-4, 0.0}, sent, false)) << "rounding";
}

TEST(EnergyAccount, AllowsChanceWhereTheirFluxDiffers) {
  EXPECT_TRUE(energy_adds_up({1e6 - 1500.0, 300.0}, 1'000'000, true));
  EXPECT_FALSE(energy_adds_up({1e6 - 7000.0, 300.0}, 1'000'000, true));
}

}  // namespace
}  // namespace evenglow::design
