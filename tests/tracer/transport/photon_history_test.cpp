#include "tracer/transport/photon_history.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/photon_account.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;

TEST(PhotonHistory, EveryPhotonEndsOnceAndDependsOnKeyAndIndexAlone) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [4, 2], density: 0.2}, sources: "
      "[{kind: led_row, count: 2}], "
      "reflectors: {bottom: {}, right: {kind: mirror}}, films: [{kind: diffuser}, {kind: dbef}, {kind: sheet}]");
  const DensityField density = initial_density(scene.spec);
  expect_photons_end_once_and_alone(scene, PhotonHistory(scene, density), 2000);
}

/// An event at least for each photon that leaves its LED.
TEST(PhotonHistory, CountsItsEvents) {
  const Scene scene =
      scene_of("light_guide_plate: {length_mm: 20, width_mm: 10}, sources: [{kind: led_row, count: 2}]");
  const DensityField density = initial_density(scene.spec);
  BatchSums sums(scene);
  for (std::uint64_t i = 0; i < 2000; ++i) PhotonHistory(scene, density).run({1, 0, 0}, i, sums);
  EXPECT_GT(sums.events[0], 2000.0);
}

TEST(PhotonHistory, GivesUpAPhotonThatNeverEnds) {
  const Scene scene = scene_of(
      "size: {length_mm: 20, width_mm: 10}, reflectors: {bottom: {kind: mirror, reflectance: 1}, top: {kind: mirror, "
      "reflectance: 1}}, "
      "sources: [{kind: beam}]");
  const DensityField density = initial_density(scene.spec);
  BatchSums sums(scene);
  PhotonHistory(scene, density).run({1, 0, 0}, 0, sums);
  EXPECT_EQ(sums.energy[scene.energy.lost_bin(LossReason::kStuck)], 1.0);
  EXPECT_EQ(account(sums), 1.0);
  EXPECT_EQ(sums.events[0], static_cast<double>(PhotonHistory::kMaxEvents));
}

/// Corners of perfect mirrors far from the origin, where single precision has steps of 0.001 mm: no photon is caught
/// between wall and film.
TEST(PhotonHistory, CornersOfMirrorsAreNoTraps) {
  const std::string mirror = "{kind: mirror, reflectance: 1, gap_mm: 0.001}";
  for (const char* bottom : {"white", "mirror"}) {
    const Traced traced(std::string("size: {length_mm: 9999, width_mm: 9999}, reflectors: {bottom: {kind: ") + bottom +
                            ", reflectance: 0.9}, left: " + mirror + ", right: " + mirror + ", front: " + mirror +
                            ", back: " + mirror +
                            "}, films: [{kind: dbef}], sources: [{kind: lambertian_face, face: right}]",
                        {10'000, 1, 10, 1});
    EXPECT_EQ(traced.lost(), 0.0) << bottom;
  }
}

/// Light on an edge of two walls, on its way into the box or towards the other wall: it never gets out between them.
TEST(PhotonHistory, EdgesOfWallsAreTight) {
  const std::string wall = "{kind: mirror, reflectance: 1, gap_mm: 0.1}";
  const Scene scene = scene_of(
      "size: {length_mm: 118.7, width_mm: 66}, reflectors: {bottom: {gap_mm: 0.05, reflectance: "
      "1}, left: {}, right: {}, front: " +
      wall + ", back: " + wall + "}, films: [{kind: diffuser}], sources: [{kind: lambertian_face, face: left}]");
  const DensityField density = initial_density(scene.spec);
  const PhotonHistory history(scene, density);
  const auto on_border = [&](Side side) {
    for (std::size_t i = 0; i < scene.caster->quads().size(); ++i) {
      const Quad& quad = scene.caster->quads()[i];
      const int axis = axis_of(side);
      if (quad.u[axis] == 0.0 && quad.v[axis] == 0.0 && quad.corner[axis] == scene.box.plane(side)) {
        return static_cast<int>(i);
      }
    }
    return -1;
  };
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 20'000; ++i) {
    const bool at_back = i % 2 == 0;  // left last: the back, going in or down; the bottom, going in or to the back
    PhotonHistory::Walk walk = history.start(rng);
    walk.photon.position = {1.0 + 116.0 * rng.uniform(), scene.box.max.y(), scene.box.min.z()};
    const double y = rng.uniform() - (at_back ? 1.0 : 0.5), z = rng.uniform() - (at_back ? 0.5 : 0.0);
    const core::Vec3 k = core::Vec3(2.0 * rng.uniform() - 1.0, y, z).normalized();
    walk.photon.light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(k));
    walk.photon.quad = on_border(at_back ? Side::kBack : Side::kBottom);
    walk.corner = i % 4 < 2 ? -1 : on_border(at_back ? Side::kBottom : Side::kBack);
    walk.photon.body = -1;
    BatchSums sums(scene);
    while (history.step(walk, rng, sums)) {
    }
    for (const Side side : {Side::kLeft, Side::kRight, Side::kFront, Side::kBack, Side::kBottom}) {
      ASSERT_EQ(sums.energy[static_cast<std::size_t>(side)], 0.0) << i << ", " << k.transpose();
    }
  }
}

/// Beer-Lambert: a beam through 10 mm of an index next to 1.
TEST(PhotonHistory, BulkAbsorption) {
  for (const double per_m : {0.0, 20.0, 200.0}) {
    const Traced traced(
        "light_guide_plate: {length_mm: 20, width_mm: 20, thickness_mm: 10, refractive_index: 1.0001, "
        "absorption_per_m: " +
            text_of(per_m) + "}, sources: [{kind: beam, gap_mm: 1}]",
        {40'000, 1, 10, 1});
    EXPECT_LT(
        std::abs(binomial_z(traced.absorbed("light_guide_plate"), traced.photons(), 1.0 - std::exp(-per_m * 0.01))),
        z_limit(1e-3, 3))
        << per_m;
  }
}

/// Photons are shared among sources by their flux.
TEST(PhotonHistory, SourcesShareByFlux) {
  const Traced traced(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: beam, flux_lm: 3}, {kind: beam, face: top, flux_lm: 1}, "
      "{kind: beam, flux_lm: 6}]",
      {40'000, 1, 10, 1});
  EXPECT_EQ(traced.result().flux, 10.0);
  EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kBottom), traced.photons(), 0.1)), two_sided_z(1e-3));
  EXPECT_EQ(traced.accounted(), traced.photons());
}

}  // namespace
}  // namespace evenglow::tests
