#include "design/engine/photon_plan.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

constexpr std::size_t kCells = 5000;  // sqrt(2/n) = 0.02

StepRecord step(std::uint64_t photons, double rms, double se, double noise) {
  StepRecord record;
  record.photons = photons;
  record.rms_corrected = {rms, se};
  record.noise = noise;
  return record;
}

std::uint64_t next(const std::vector<StepRecord>& steps, std::optional<double> noise_left,
                   std::uint64_t most = 1'000'000, double wanted = 0.01) {
  DesignSpec spec;
  spec.stop_rms = 0.01;
  std::optional<Foresight> foresight;
  if (noise_left) foresight = Foresight{*noise_left, wanted};
  return next_photons(steps, foresight, kCells, spec, {1000, most});
}

TEST(PhotonPlan, GrowsWhereNoiseHidesTheRms) {
  EXPECT_EQ(next({step(1000, 0.03, 0.001, 0.05)}, {}), 4000U);
  EXPECT_EQ(next({step(1000, 0.03, 0.01, 0.02)}, {}), 4000U) << "its error is above 0.15 of it";
  EXPECT_EQ(next({step(1000, 0.3, 0.01, 0.1)}, {}), 1000U);
  EXPECT_EQ(next({step(1000, 0.03, 0.001, 0.05)}, {}, 3000), 3000U);
}

TEST(PhotonPlan, GrowsAsTheNoiseInTheDensityAsks) {
  EXPECT_EQ(next({step(1000, 0.5, 0.01, 0.1)}, 0.02), 4000U) << "however uneven the step was";
  EXPECT_EQ(next({step(1000, 0.5, 0.01, 0.1)}, 0.005 * std::sqrt(2.0)), 2000U);
}

TEST(PhotonPlan, ShowsWithAsManyAsItTakes) {
  // Error at 1 %: 0.02 noise^2 / 0.02 = noise^2; wanted 0.001.
  EXPECT_NEAR(static_cast<double>(next({step(100'000, 0.02, 0.001, std::sqrt(0.0005))}, 0.004)), 50'000.0, 1.0);
  EXPECT_EQ(next({step(100'000, 0.02, 0.001, 0.001)}, 0.004), 25'000U) << "a quarter at least";
  EXPECT_EQ(next({step(100'000, 0.02, 0.001, 0.1)}, 0.004), 100'000U) << "never more than before";
  EXPECT_EQ(next({step(100'000, 0.02, 0.001, 0.001), step(25'000, 0.02, 0.001, 0.002)}, 0.004), 200'000U)
      << "it was not there yet";
}

TEST(PhotonPlan, AsksNoMoreThanLimitsLetTheDesignReach) {
  EXPECT_EQ(next({step(100'000, 0.5, 0.001, 0.1)}, 0.02), 400'000U);
  EXPECT_LE(next({step(100'000, 0.5, 0.001, 0.1)}, 0.02, 1'000'000, 0.05), 100'000U);
}

}  // namespace
}  // namespace evenglow::design
