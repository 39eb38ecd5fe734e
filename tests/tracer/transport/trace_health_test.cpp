#include "tracer/transport/trace_health.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;

constexpr const char* kPlate =
    "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [4, 2], density: 0.2}, sources: [{kind: "
    "led_row, count: 2}], reflectors: {bottom: {}}, receivers: [{kind: luminance, cells: [4, 2]}]";

/// A trace of 1000 photons in 10 batches that does to the sums what `photon` says.
class TraceHealth : public ::testing::Test {
 protected:
  /// What is told of such a trace; empty: nothing.
  std::string told(const PhotonReplay& photon) const {
    TraceOptions options;
    options.photons = 1000;
    options.batches = 10;
    options.key = {7, 2, 5};
    TraceResult result{options.photons,
                       1.0,
                       core::Tally(scene_.luminance.bins()),
                       core::Tally(0),
                       core::Tally(0),
                       core::Tally(scene_.energy.bins()),
                       core::Tally(scene_.angular ? scene_.angular->bins() : 0),
                       0.0};
    for (std::uint64_t batch = 0; batch < 10; ++batch) {
      BatchSums sums(scene_);
      for (std::uint64_t i = 0; i < 100; ++i) photon(100 * batch + i, sums);
      result.luminance.add_batch(sums.luminance);
      result.color_x.add_batch({});
      result.color_z.add_batch({});
      result.energy.add_batch(sums.energy);
      result.angular.add_batch(sums.angular);
    }
    try {
      check_health(scene_, result, options, photon);
      return "";
    } catch (const core::Error& error) {
      return error.what();
    }
  }

  Scene scene_ = tests::scene_of(kPlate);
};

TEST_F(TraceHealth, OfAGoodTraceIsGood) {
  EXPECT_EQ(told([](std::uint64_t, BatchSums& sums) { sums.energy[0] += 1.0; }), "");
}

TEST_F(TraceHealth, FewLostPhotonsAreAllowedAndTheFirstOfManyIsNamed) {
  const auto losing = [&](std::uint64_t first, std::uint64_t count) {
    return told([=, this](std::uint64_t photon, BatchSums& sums) {
      const bool lost = photon >= first && photon < first + count;
      sums.energy[lost ? scene_.energy.lost_bin(LossReason::kStuck) : 0] += 1.0;
    });
  };
  EXPECT_EQ(losing(337, 10), "");
  EXPECT_EQ(
      losing(337, 11),
      "too many photons were lost: 11 of 1000 (0 leaked, 11 stuck, 0 invalid); the first is photon 337 of step 5: "
      "`evenglow trace RUN.yaml --seed 7 --photon 337 --step 5 --stream 2` shows its way");
}

TEST_F(TraceHealth, OnePhotonThatIsNoNumberStopsTheRun) {
  EXPECT_THAT(told([&](std::uint64_t photon, BatchSums& sums) {
                sums.energy[photon == 612 ? scene_.energy.lost_bin(LossReason::kInvalid) : 0] += 1.0;
              }),
              HasSubstr("(0 leaked, 0 stuck, 1 invalid); the first is photon 612 of step 5"));
}

TEST_F(TraceHealth, ASumThatIsNoPowerStopsTheRun) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -500.0}) {
    const auto message = told([&](std::uint64_t photon, BatchSums& sums) {
      sums.energy[0] += 1.0;
      sums.luminance[3] += photon == 950 ? bad : 1.0;
    });
    EXPECT_THAT(message, HasSubstr("the luminance holds"));
    EXPECT_THAT(message, HasSubstr("the first is photon 950 of step 5"));
  }
}

}  // namespace
}  // namespace evenglow::tracer
