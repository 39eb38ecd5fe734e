#include "tracer/scene/scene_builder.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

TEST(SceneBuilder, WavelengthChangesTheOpticsAndNothingElse) {
  const Scene scene = scene_of(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.5, material: pmma}, sources: [{kind: led_row, "
      "count: 2, size_mm: [2, 0.4], gap_mm: 0.1}], reflectors: {bottom: {gap_mm: 0.1}}, films: [{kind: diffuser}]");
  SceneBuilder blue(scene.spec, 450.0);
  SceneBuilder red(scene.spec, 650.0);
  const SceneOptics at_blue = blue.take_optics();
  const SceneOptics at_red = red.take_optics();
  EXPECT_GT(at_blue.bodies[0].refractive_index, at_red.bodies[0].refractive_index + 0.005);
  EXPECT_EQ(blue.take_parts(), red.take_parts());
  const auto quads = blue.take_quads();
  const auto same = red.take_quads();
  ASSERT_EQ(quads.size(), same.size());
  ASSERT_EQ(quads.size(), at_blue.surfaces.size());
  for (std::size_t i = 0; i < quads.size(); ++i) {
    EXPECT_EQ(quads[i].corner, same[i].corner);
    EXPECT_EQ(at_blue.surfaces[i].part, at_red.surfaces[i].part);
    EXPECT_EQ(at_blue.surfaces[i].body, at_red.surfaces[i].body);
  }
}

TEST(SceneBuilder, SourceBeforeAReflectorHasQuadsOfItsOwnElseItIsAWindow) {
  const std::string plate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.5}, ";
  const std::string leds = "sources: [{kind: led_row, count: 3, pitch_mm: 3, size_mm: [2, 0.4], gap_mm: 0.1}], ";
  const Scene before = scene_of(plate + leds + "reflectors: {left: {gap_mm: 0.2}}");
  const Scene within = scene_of(plate + leds + "reflectors: {left: {gap_mm: 0.1}}");
  EXPECT_TRUE(before.source_placements[0].quad_per_window);
  EXPECT_EQ(before.caster->quads().size(), within.caster->quads().size() + 3);
  ASSERT_FALSE(within.source_placements[0].quad_per_window);
  const auto quad = static_cast<std::size_t>(within.source_placements[0].first_quad);
  EXPECT_EQ(within.optics[0].surfaces[quad].windows.size(), 3U);
  EXPECT_NEAR(within.caster->quads()[quad].corner.x(), -0.1, 1e-12);
}

}  // namespace
}  // namespace evenglow::tests
