#include "tracer/transport/planar_history.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/photon_account.h"
#include "tests/support/two_paths.h"
#include "tests/support/z_test.h"

/// The planar path against closed forms; against the general path: tests/statistical/planar_path_test.cpp.
namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [8, 4], density: 0.2}, "
    "sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}, right: {kind: mirror}}, films: [{kind: diffuser}, "
    "{kind: dbef}, {kind: sheet}]";

TEST(PlanarHistory, EveryPhotonEndsOnceAndDependsOnKeyAndIndexAlone) {
  const Scene scene = scene_of(kBacklight);
  const DensityField density = initial_density(scene.spec);
  const auto layers = PlanarScene::of(scene);
  ASSERT_TRUE(layers);
  expect_photons_end_once_and_alone(scene, PlanarHistory(scene, *layers, density), 2000);
}

TEST(PlanarHistory, GivesUpAPhotonThatNeverEnds) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, refractive_index: 1.5, absorption_per_m: 0}, reflectors: "
      "{bottom: "
      "{kind: mirror, reflectance: 1}, top: {kind: mirror, reflectance: 1, gap_mm: 1}}, sources: [{kind: beam, face: "
      "top, "
      "gap_mm: 0.5}]");
  const DensityField density = initial_density(scene.spec);
  const auto layers = PlanarScene::of(scene);
  ASSERT_TRUE(layers);
  BatchSums sums(scene);
  PlanarHistory(scene, *layers, density).run({1, 0, 0}, 0, sums);
  EXPECT_EQ(sums.energy[scene.energy.lost_bin(LossReason::kStuck)], 1.0);
  EXPECT_GE(sums.events[0], static_cast<double>(PhotonHistory::kMaxEvents));
}

/// Bare lossless slab, Lambertian natural light at its end face: the shares that leave by the two ends are those of an
/// independent sum over a lattice of field vectors (tests/statistical/closed_forms_slab_test.cpp at this size: .150814
/// and .849186). False alarm 0.003.
TEST(PlanarHistory, BareSlab) {
  const Traced traced(
      "light_guide_plate: {length_mm: 6, width_mm: 4, thickness_mm: 2.5, refractive_index: 1.4938}, "
      "sources: [{kind: lambertian_face, face: left}]",
      {2'000'000, 3, 10, 1});
  ASSERT_TRUE(takes_planar_path(traced.scene(), TracePath::kAuto));
  EXPECT_EQ(traced.escaped(Side::kLeft) + traced.escaped(Side::kRight), traced.photons());
  EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kLeft), traced.photons(), 0.150814)), 3.0);
}

/// exp(-a L) along a pencil beam through a plate of an index next to 1: its faces reflect 2.5e-9.
TEST(PlanarHistory, BulkAbsorption) {
  const Traced traced(
      "light_guide_plate: {length_mm: 100, width_mm: 10, thickness_mm: 2, refractive_index: 1.0001, absorption_per_m: "
      "10}, "
      "sources: [{kind: beam, face: left}]",
      {200'000, 4, 10, 1});
  EXPECT_LT(std::abs(binomial_z(traced.absorbed("light_guide_plate"), traced.photons(), 1.0 - std::exp(-1.0))),
            two_sided_z(1e-3));
}

TEST(PlanarHistory, SameBitsOnAnyNumberOfThreads) {
  const Traced one(kBacklight, {20'000, 5, 40, 1});
  for (const int threads : {2, 4}) {
    const Traced many(kBacklight, {20'000, 5, 40, threads});
    for (std::size_t i = 0; i < 40; ++i) {
      EXPECT_EQ(one.result().energy.batch(i), many.result().energy.batch(i));
      EXPECT_EQ(one.result().luminance.batch(i), many.result().luminance.batch(i));
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
