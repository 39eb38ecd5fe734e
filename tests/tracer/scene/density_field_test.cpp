#include "tracer/scene/density_field.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

TEST(DensityField, ConstantInACellNearestBeyond) {
  DensityField field{core::CellField(core::CellGrid::over(2, 1, 0, 0, 4, 1), 0.0)};
  field.cells.values = {0.1, 0.9};
  EXPECT_EQ(field.at(1.999, 0.5), 0.1);
  EXPECT_EQ(field.at(2.001, 0.5), 0.9);
  EXPECT_EQ(field.at(-3.0, 7.0), 0.1);
  EXPECT_EQ(field.at(9.0, -7.0), 0.9);
  const DensityField limited = clamped(field, 0.2, 0.8);
  EXPECT_EQ(limited.cells.values, (std::vector<double>{0.2, 0.8}));
}

TEST(DensityField, InitialIsThatOfTheRunFile) {
  const std::string plate = "light_guide_plate: {length_mm: 20, width_mm: 10}, sources: [{kind: led_row, count: 2}]";
  EXPECT_EQ(initial_density(backlight_of(plate)).at(3.0, 3.0), 0.0);
  const DensityField field = initial_density(backlight_of(plate + ", microstructure: {cells: [4, 3], density: 0.25}"));
  EXPECT_EQ(field.cells.grid, core::CellGrid::over(4, 3, 0, 0, 20, 10));
  EXPECT_EQ(field.at(3.0, 3.0), 0.25);
}

/// The tracer reads the density where the photon is: the beam lights the two middle cells of four, whatever the outer
/// ones hold. False alarm 1e-3.
TEST(DensityField, RulesTheOddsCellByCell) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1, refractive_index: 1.0001}, "
      "microstructure: {face: bottom, cells: [4, 1], density: 0.5, reflectance: 0}, "
      "sources: [{kind: beam, face: top, size_share: 0.5, gap_mm: 0.5}]");
  DensityField density = initial_density(scene.spec);
  for (const auto& [left, right] : {std::pair{0.1, 0.6}, {0.0, 0.9}}) {
    density.cells.values = {1.0, left, right, 1.0};
    TraceOptions options;
    options.photons = 40'000;
    options.batches = 10;
    options.threads = 1;
    const auto result = trace(scene, density, options);
    const double absorbed = result->energy.total(scene.energy.absorbed_bin(1)).value;
    EXPECT_LT(std::abs(binomial_z(absorbed, 40'000, 0.5 * (left + right))), z_limit(1e-3, 2));
  }
}

}  // namespace
}  // namespace evenglow::tests
