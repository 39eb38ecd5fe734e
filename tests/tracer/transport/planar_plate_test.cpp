#include "tracer/transport/planar_plate.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kLit = "sources: [{kind: lambertian_face, face: left}]";

std::optional<PlanarPlate> plate_of(const std::string& backlight) {
  const Scene scene = scene_of(backlight);
  return PlanarPlate::of(scene, *PlanarScene::of(scene), 0);
}

TEST(PlanarPlate, TakesWhatTheSceneSays) {
  const auto plate = plate_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, refractive_index: 1.5, absorption_per_m: 4}, "
      "microstructure: {face: top, cells: [4, 2], density: 0.2}, " +
      kLit);
  ASSERT_TRUE(plate);
  EXPECT_EQ(plate->refractive_index, 1.5);
  EXPECT_DOUBLE_EQ(plate->absorption, 0.004);
  EXPECT_EQ(plate->pattern_side, static_cast<int>(Side::kTop));
  EXPECT_NE(plate->pattern, nullptr);
  EXPECT_EQ(plate->box.max.z(), 2.0);
  for (const bool smooth : plate->smooth) EXPECT_TRUE(smooth);
}

TEST(PlanarPlate, UniformNumbersAreUsedAgain) {
  const auto plate = plate_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}, microstructure: {cells: [4, 2], density: "
      "0.2, "
      "reflectance: 0.8, specular_share: 0.25}, " +
      kLit);
  ASSERT_TRUE(plate && plate->dots.known);
  EXPECT_DOUBLE_EQ(plate->dots.mirrored, 0.2);
  EXPECT_DOUBLE_EQ(plate->dots.per_mirrored, 5.0);
  EXPECT_NEAR(plate->dots.again(0.2), 0.0, 1e-15);
  EXPECT_NEAR(plate->dots.again(0.5), 0.5, 1e-15);
  EXPECT_NEAR(plate->dots.again(0.8), 1.0, 1e-15);
}

TEST(PlanarPlate, KnowsSerratedWallsAndMissingPlates) {
  const auto serrated =
      plate_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, entrance: {flank_deg: 35}}, " + kLit);
  ASSERT_TRUE(serrated);
  EXPECT_FALSE(serrated->smooth[0]);
  EXPECT_TRUE(serrated->smooth[1]);
  EXPECT_EQ(serrated->pattern_side, -1);
  EXPECT_FALSE(
      plate_of("size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: "
               "[{kind: diffuser}]"));
}

}  // namespace
}  // namespace evenglow::tests
