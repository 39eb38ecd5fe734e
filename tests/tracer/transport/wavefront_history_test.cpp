#include "tracer/transport/wavefront_history.h"

#include <gtest/gtest.h>

#include "tests/support/photon_account.h"
#include "tests/support/scenes.h"
#include "tracer/wavefront/plate_kernel.h"

/// Against the planar path: tests/statistical/wavefront_path_test.cpp.
namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [8, 4], density: 0.2}, "
    "sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: {kind: mirror}}, films: [{kind: diffuser}, "
    "{kind: dbef}, {kind: sheet}], receivers: [{kind: luminance, estimator: counting, cells: [20, 10]}, {kind: "
    "angular}]";

TraceResult traced(const Scene& scene, int threads, std::uint64_t photons = 20'000) {
  TraceOptions options;
  options.photons = photons;
  options.batches = 20;
  options.threads = threads;
  options.key.seed = 3;
  options.path = TracePath::kWavefront;
  return *trace(scene, initial_density(scene.spec), options);
}

void expect_same(const TraceResult& a, const TraceResult& b) {
  EXPECT_EQ(a.events, b.events);
  for (std::size_t bin = 0; bin < a.energy.bins(); ++bin) {
    EXPECT_EQ(a.energy.total(bin).value, b.energy.total(bin).value);
  }
  for (std::size_t bin = 0; bin < a.luminance.bins(); ++bin) {
    EXPECT_EQ(a.luminance.total(bin).value, b.luminance.total(bin).value);
    EXPECT_EQ(a.luminance.total(bin).se, b.luminance.total(bin).se);
  }
  for (std::size_t bin = 0; bin < a.angular.bins(); ++bin) {
    EXPECT_EQ(a.angular.total(bin).value, b.angular.total(bin).value);
  }
}

TEST(WavefrontHistory, SameBitsForAnyNumberOfThreadsAndAnyInstructionSet) {
  const Scene scene = scene_of(kBacklight);
  const TraceResult one = traced(scene, 1);
  expect_same(one, traced(scene, 2));
  expect_same(one, traced(scene, 4));
  for (const std::int64_t set : instruction_sets()) {
    force_instruction_set(set);
    expect_same(one, traced(scene, 1));
    force_instruction_set(0);
  }
}

TEST(WavefrontHistory, EveryPhotonEndsOnceAndAloneAsInABatch) {
  const Scene scene = scene_of(kBacklight);
  const DensityField density = initial_density(scene.spec);
  const auto layers = PlanarScene::of(scene);
  const WavefrontHistory history(scene, *layers, density);
  BatchSums batch(scene), alone(scene);
  history.run({1, 2, 3}, core::BatchRange{0, 100, 1500}, batch);
  for (std::uint64_t photon = 0; photon < 1500; ++photon) {
    history.run({1, 2, 3}, 100 + photon, alone);
    ASSERT_EQ(account(alone), static_cast<double>(photon + 1));
  }
  expect_same_sums(batch, alone);
}

TEST(WavefrontHistory, GivesUpAPhotonThatNeverEnds) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, refractive_index: 1.5, absorption_per_m: 0}, reflectors: "
      "{bottom: {kind: mirror, reflectance: 1}, top: {kind: mirror, reflectance: 1, gap_mm: 1}}, sources: [{kind: "
      "beam, face: top, gap_mm: 0.5}], receivers: [{kind: luminance, estimator: counting}]");
  const DensityField density = initial_density(scene.spec);
  const auto layers = PlanarScene::of(scene);
  BatchSums sums(scene);
  WavefrontHistory(scene, *layers, density).run({1, 0, 0}, 0, sums);
  EXPECT_EQ(sums.energy[scene.energy.lost_bin(LossReason::kStuck)], 1.0);
  EXPECT_GE(sums.events[0], static_cast<double>(PhotonHistory::kMaxEvents));
}

TEST(WavefrontHistory, StopsWhenItIsAskedTo) {
  const Scene scene = scene_of(kBacklight);
  TraceOptions options;
  options.photons = 100'000'000;
  options.batches = 10;
  options.path = TracePath::kWavefront;
  std::stop_source source;
  source.request_stop();
  options.stop = source.get_token();
  EXPECT_FALSE(trace(scene, initial_density(scene.spec), options).has_value());
}

}  // namespace
}  // namespace evenglow::tests
