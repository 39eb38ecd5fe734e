#include <cmath>
#include <memory>

#include <gtest/gtest.h>

#include "tests/support/photon_account.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/microstructure/dot_grid.h"
#include "tracer/transport/planar_history.h"

/// The planar path over dots one by one (planar_history.h). Against the general path:
/// tests/statistical/dot_path_test.cpp.
namespace evenglow::tests {
namespace {

using namespace tracer;

/// Dots of 1 mm on a raster of 2 mm: pi/16 of the face is under them, 1/4 if they are square.
std::shared_ptr<const DotGrid> dots_of(core::Footprint footprint) {
  core::DotPattern dots;
  for (double y = 1.0; y < 10.0; y += 2.0) {
    for (double x = 1.0; x < 20.0; x += 2.0) dots.push_back({x, y, 0.5f, 0.3f});
  }
  return std::make_shared<const DotGrid>(dots, footprint, FaceArea{0.0, 20.0, 0.0, 10.0});
}

DensityField density_of(const Scene& scene, core::Footprint footprint) {
  DensityField density = initial_density(scene.spec);
  density.dots = dots_of(footprint);
  density.cells = density.dots->coverage(density.cells.grid);
  return density;
}

TEST(DotPlanarHistory, EveryPhotonEndsOnceAndDependsOnKeyAndIndexAlone) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [8, 4]}, sources: [{kind: led_row, "
      "count: 2}], reflectors: {bottom: {}, right: {kind: mirror}}, films: [{kind: diffuser}, {kind: dbef}]");
  const auto layers = PlanarScene::of(scene);
  ASSERT_TRUE(layers);
  const DensityField density = density_of(scene, core::Footprint::round);
  expect_photons_end_once_and_alone(scene, DotPlanarHistory(scene, *layers, density), 2000);
}

/// A beam straight down on a plate whose dots are black: what enters, 1 - R, is taken by the dots where they are, and a
/// part that the bare face reflects comes back to the same bare place. So the dots take (1 - R) times their share of
/// the face, to the last ray: pi/16 for round dots, 1/4 for square ones. |z| below 3.9, false alarm 1e-4 each.
TEST(DotPlanarHistory, BlackDotsTakeTheirShareOfAStraightBeam) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, refractive_index: 1.5, absorption_per_m: 0}, microstructure: "
      "{cells: [8, 4], kind: printed_dot, reflectance: 0}, sources: [{kind: beam, face: top}]");
  const auto layers = PlanarScene::of(scene);
  ASSERT_TRUE(layers);
  const double enters = 1.0 - std::pow(0.5 / 2.5, 2);
  for (const core::Footprint footprint : {core::Footprint::round, core::Footprint::square}) {
    const DensityField density = density_of(scene, footprint);
    const DotPlanarHistory history(scene, *layers, density);
    BatchSums sums(scene);
    constexpr std::uint64_t kPhotons = 200'000;
    for (std::uint64_t i = 0; i < kPhotons; ++i) history.run({5, 0, 0}, i, sums);
    double taken = 0.0;
    for (std::size_t part = 0; part < scene.energy.parts().size(); ++part) {
      if (scene.energy.parts()[part].rfind("microstructure", 0) == 0)
        taken += sums.energy[scene.energy.absorbed_bin(static_cast<int>(part))];
    }
    const double expected = enters * core::footprint_area(footprint, 1.0) / 4.0;
    const double se = std::sqrt(expected * (1.0 - expected) / kPhotons);
    EXPECT_LT(std::abs(taken / kPhotons - expected), 3.9 * se) << taken / kPhotons << " " << expected;
  }
}

}  // namespace
}  // namespace evenglow::tests
