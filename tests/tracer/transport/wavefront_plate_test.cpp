#include "tracer/transport/wavefront_plate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;
using ::testing::HasSubstr;

const std::string kSlab =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, refractive_index: 1.5, absorption_per_m: 4}, "
    "microstructure: {cells: [4, 2], density: 0.25, reflectance: 0.9}, sources: [{kind: lambertian_face, face: left}], "
    "reflectors: {bottom: {reflectance: 0.95, gap_mm: 0.3}, right: {kind: mirror, reflectance: 0.8, gap_mm: 0.2}}, ";
const std::string kCounted = "receivers: [{kind: luminance, estimator: counting}]";

std::string reason_of(const std::string& yaml) {
  std::string reason;
  EXPECT_FALSE(wavefront_serves(scene_of(yaml), &reason));
  return reason;
}

TEST(WavefrontPlate, TellsWhyItDoesNotServe) {
  EXPECT_TRUE(wavefront_serves(scene_of(kSlab + kCounted)));
  EXPECT_THAT(reason_of("size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: "
                        "[{kind: diffuser}], " +
                        kCounted),
              HasSubstr("no plate"));
  EXPECT_THAT(reason_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, end_thickness_mm: 1}, "
                        "sources: [{kind: lambertian_face, face: left}], " +
                        kCounted),
              HasSubstr("neither parallel nor square"));
  EXPECT_THAT(reason_of("light_guide_plate: {length_mm: 20, width_mm: 10, material: pmma}, sources: [{kind: led_row, "
                        "count: 1, spectrum: {kind: white_led}}], " +
                        kCounted),
              HasSubstr("several wavelengths"));
}

TEST(WavefrontPlate, RefusesInOneLine) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, end_thickness_mm: 0.4}, sources: [{kind: "
      "lambertian_face, face: left}], " +
      kCounted);
  TraceOptions options;
  options.photons = options.batches = 10;
  options.path = TracePath::kWavefront;
  try {
    trace(scene, initial_density(scene.spec), options);
    FAIL() << "must be refused";
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trace.path: wavefront"));
    EXPECT_THAT(error.what(), HasSubstr("allowed here: auto, planar, general"));
  }
}

TEST(WavefrontPlate, ConstantsAreThoseOfTheScene) {
  const Scene scene = scene_of(kSlab + kCounted);
  const auto layout = PlanarScene::of(scene);
  const auto plate = PlanarPlate::of(scene, *layout, 0);
  ASSERT_TRUE(plate);
  const PlateConstants c = plate_constants(scene, *layout, *plate, initial_density(scene.spec));
  EXPECT_EQ(c.max_x, 20.0);
  EXPECT_EQ(c.height, 2.0);
  EXPECT_NEAR(c.absorption, 0.004, 1e-15);
  EXPECT_NEAR(c.per_absorption, 250.0, 1e-9);
  EXPECT_TRUE(c.open_above);
  EXPECT_EQ(c.pattern_side, 4);
  EXPECT_EQ(c.dots.reflectance, 0.9);
  EXPECT_EQ(c.below.reflectance, 0.95);
  EXPECT_NEAR(c.below.gap, 0.3, 1e-12);
  EXPECT_EQ(c.backing_known, (std::array<double, 4>{0.0, 1.0, 0.0, 0.0}));
  EXPECT_EQ(c.backing_mirrored[1], 0.8);
  EXPECT_NEAR(c.backing_gap[1], 0.2, 1e-12);
  EXPECT_TRUE(c.all_smooth);
  EXPECT_EQ(c.nx, 4);
  EXPECT_EQ(c.open, std::vector<float>(8, 0.75F));
}

}  // namespace
}  // namespace evenglow::tests
