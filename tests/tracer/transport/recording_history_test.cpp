#include "tracer/transport/recording_history.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

/// What is taken down of a history; what is made of it: arrival_records_test.
namespace evenglow::tests {
namespace {

using namespace tracer;

constexpr double kDensity = 0.3;
const std::string kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [8, 4], density: "
    "0.3, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: "
    "{}}, films: [{kind: diffuser}], receivers: [{kind: luminance, cells: [8, 4], cone_deg: 60, estimator: counting}]";
const core::RandomKey kKey{3, 1, 4};

/// The events of a log.
struct Events {
  std::vector<double> light;  ///< of each cell of the display
  std::vector<std::size_t> arrivals;
  std::size_t met = 0, passed = 0, photons = 0;
};

Events events_of(ArrivalLog log, std::size_t bins, std::size_t cells) {
  Events events{std::vector<double>(bins), std::vector<std::size_t>(cells)};
  const std::vector<std::uint32_t> words = log.take();
  for (std::size_t i = 0; i < words.size(); ++i) {
    const std::size_t index = words[i] & ArrivalLog::kMostIndex;
    switch (static_cast<LogKind>(words[i] >> ArrivalLog::kKindShift)) {
      case LogKind::kMet:
        ++events.met;
        ++events.arrivals.at(index);
        break;
      case LogKind::kPassed:
        ++events.passed;
        ++events.arrivals.at(index);
        break;
      case LogKind::kDeposit:
      case LogKind::kShared:
        events.light.at(index) += static_cast<double>(std::bit_cast<float>(words[++i]));
        break;
      case LogKind::kPhotonEnd:
        ++events.photons;
        break;
      case LogKind::kCrossed:
      case LogKind::kShare:
        break;
    }
  }
  return events;
}

void expect_same(const BatchSums& a, const BatchSums& b) {
  EXPECT_EQ(a.luminance, b.luminance);
  EXPECT_EQ(a.energy, b.energy);
  EXPECT_EQ(a.events, b.events);
}

class Recording : public ::testing::Test {
 protected:
  Recording() : scene_(scene_of(kBacklight)), density_(initial_density(scene_.spec)) {}

  Scene scene_;
  DensityField density_;
  PlanarScene layout_ = PlanarScene::of(scene_).value();
  PlanarHistory plain_{scene_, layout_, density_};
  PlanarRecordingHistory planar_{scene_, layout_, density_};
};

TEST_F(Recording, ChangesNoNumberOfTheTrace) {
  BatchSums expected(scene_), unrecorded(scene_), recorded(scene_);
  ArrivalLog log(1 << 20);
  for (std::uint64_t i = 0; i < 500; ++i) {
    plain_.run(kKey, i, expected);
    planar_.run(kKey, i, unrecorded);
    recorded.log = &log;
    planar_.run(kKey, i, recorded);
  }
  expect_same(unrecorded, expected);
  expect_same(recorded, expected);
  EXPECT_FALSE(log.empty());
}

/// Each deposit is there, and each arrival meets the dots with the probability of the density, whatever came before:
/// false alarm 6e-5 (4 sigma).
TEST_F(Recording, HoldsTheLightAndTheArrivalsOfEachPhoton) {
  constexpr std::size_t kPhotons = 2000;
  BatchSums sums(scene_);
  ArrivalLog log(64 << 20);
  sums.log = &log;
  for (std::uint64_t i = 0; i < kPhotons; ++i) {
    planar_.run(kKey, i, sums);
    log.end_photon();
  }
  const Events events = events_of(std::move(log), scene_.luminance.bins(), density_.cells.values.size());
  EXPECT_EQ(events.photons, kPhotons);
  double light = 0.0;
  for (std::size_t i = 0; i < events.light.size(); ++i) {
    EXPECT_NEAR(events.light[i], sums.luminance[i], 1e-5 * sums.luminance[i]) << i;
    light += events.light[i];
  }
  EXPECT_GT(light, 0.0);
  for (const std::size_t arrivals : events.arrivals) EXPECT_GT(arrivals, 0U) << "light comes to each cell";
  const double all = static_cast<double>(events.met + events.passed);
  EXPECT_GT(all, 1.0 * kPhotons);
  EXPECT_LT(std::abs(static_cast<double>(events.met) - kDensity * all),
            4.0 * std::sqrt(kDensity * (1.0 - kDensity) * all));
}

/// Three batches of 100 photons, met in any order: each has a log of its own, and stops to record when it is full.
TEST_F(Recording, EachBatchKeepsToItsShareOfTheMemory) {
  constexpr std::size_t kBatches = 3, kBatch = 100, kBytes = 1200;
  RecordingHistory<PlanarRecordingHistory> recording(planar_, kBatch, kBatches, kBatches * kBytes);
  for (const std::size_t batch : {2U, 0U, 1U}) {
    BatchSums expected(scene_), sums(scene_);
    for (std::uint64_t i = batch * kBatch; i < (batch + 1) * kBatch; ++i) {
      plain_.run(kKey, i, expected);
      recording.run(kKey, i, sums);
      EXPECT_EQ(sums.log, nullptr) << "the log is let go of after each photon";
    }
    expect_same(sums, expected);
  }
  std::vector<ArrivalLog> logs = recording.take_logs();
  ASSERT_EQ(logs.size(), kBatches);
  for (std::size_t batch = 0; batch < kBatches; ++batch) {
    const std::size_t photons = logs[batch].photons();
    EXPECT_GT(photons, 1U);
    EXPECT_LT(photons, kBatch) << "the test could not fail";
    // The first photons of the batch, and these alone.
    ArrivalLog expected(kBytes);
    BatchSums sums(scene_);
    sums.log = &expected;
    for (std::uint64_t i = batch * kBatch; i < batch * kBatch + photons; ++i) {
      EXPECT_TRUE(expected.has_room());
      planar_.run(kKey, i, sums);
      expected.end_photon();
    }
    EXPECT_FALSE(expected.has_room());
    EXPECT_EQ(logs[batch].take(), expected.take());
  }
}

}  // namespace
}  // namespace evenglow::tests
