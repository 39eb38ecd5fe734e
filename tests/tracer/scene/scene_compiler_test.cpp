#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tracer/scene/scene.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.5}, ";
const std::string kLeds = "sources: [{kind: led_row, count: 2, size_mm: [2, 0.4], gap_mm: 0.1}]";

std::size_t quads_of_body(const Scene& scene, int body) {
  std::size_t count = 0;
  for (const Surface& surface : scene.optics[0].surfaces) count += surface.body == body ? 1 : 0;
  return count;
}

TEST(SceneCompiler, PlateIsAClosedBodyWithNormalsOut) {
  const Scene scene = scene_of(kPlate + kLeds);
  ASSERT_EQ(scene.optics[0].bodies.size(), 1U);
  EXPECT_EQ(quads_of_body(scene, 0), 6U);
  const core::Vec3 center(10.0, 5.0, 0.25);
  for (std::size_t i = 0; i < scene.optics[0].surfaces.size(); ++i) {
    const Surface& s = scene.optics[0].surfaces[i];
    const Quad& quad = scene.caster->quads()[i];
    EXPECT_NEAR((s.x.cross(s.y) - s.normal).norm(), 0.0, 1e-15);
    if (s.body == 0) {
      EXPECT_GT(s.normal.dot(quad.corner - center), 0.0);
    }
    ASSERT_NE(s.optics, nullptr);
    if (std::abs(s.normal.z()) > 0.5) {
      EXPECT_EQ(s.x, core::Vec3::UnitX());  // film axes count from it
    }
  }
  EXPECT_EQ(scene.flux, 18.0);
  ASSERT_EQ(scene.energy.parts().size(), 2U);
  EXPECT_EQ(scene.energy.parts()[0], "light_guide_plate");
  EXPECT_EQ(scene.energy.parts()[1], "sources[0]:led_row");
}

TEST(SceneCompiler, StackHasItsHeights) {
  const Scene scene =
      scene_of(kPlate + kLeds +
               ", reflectors: {bottom: {gap_mm: 0.2}, right: {gap_mm: 0.3}}, films: [{kind: diffuser, gap_mm: 0.1}, "
               "{kind: sheet, gap_mm: 0.05, thickness_mm: 0.4, refractive_index: 1.6, absorption_per_m: 2}, {kind: "
               "lpp, gap_mm: 0.01}]");
  EXPECT_NEAR((scene.box.min - core::Vec3(0.0, 0.0, -0.2)).norm(), 0.0, 1e-12);
  EXPECT_NEAR((scene.box.max - core::Vec3(20.3, 10.0, 1.06)).norm(), 0.0, 1e-12);
  ASSERT_EQ(scene.optics[0].bodies.size(), 2U);
  EXPECT_EQ(scene.optics[0].bodies[1].refractive_index, 1.6);
  EXPECT_NEAR(scene.optics[0].bodies[1].absorption, 0.002, 1e-15);
}

TEST(SceneCompiler, PatternLiesOnItsFace) {
  for (const auto& [name, side] : {std::pair{"bottom", Side::kBottom}, {"top", Side::kTop}}) {
    const Scene scene = scene_of(kPlate + kLeds + ", microstructure: {face: " + name + ", cells: [2, 2]}");
    int patterned = 0;
    for (const Surface& surface : scene.optics[0].surfaces) {
      if (surface.pattern == nullptr) continue;
      ++patterned;
      EXPECT_NEAR((surface.normal - outward(side)).norm(), 0.0, 1e-15);
      EXPECT_EQ(scene.energy.parts()[static_cast<std::size_t>(surface.pattern_part)], "microstructure");
    }
    EXPECT_EQ(patterned, 1);
  }
}

/// LEDs in the plane of the reflector are windows in it, on quads of their own otherwise.
TEST(SceneCompiler, LedsInAndBeforeTheReflector) {
  const Scene in = scene_of(kPlate + kLeds + ", reflectors: {left: {gap_mm: 0.1}}");
  EXPECT_EQ(in.source_placements[0].first_quad, 6);
  EXPECT_FALSE(in.source_placements[0].quad_per_window);
  EXPECT_EQ(in.optics[0].surfaces[6].windows.size(), 2U);
  const Scene before = scene_of(kPlate + kLeds + ", reflectors: {left: {gap_mm: 0.4}}");
  EXPECT_EQ(before.source_placements[0].first_quad, 7);
  EXPECT_TRUE(before.source_placements[0].quad_per_window);
  EXPECT_EQ(before.optics[0].surfaces.size(), 9U);
  const Scene faces = scene_of(kPlate + "sources: [{kind: lambertian_face}]");
  EXPECT_EQ(faces.source_placements[0].first_quad, -1);
}

/// With windows in all four vertical reflectors, each photon starts in a window, whatever the axes of its quad.
TEST(SceneCompiler, WindowsMatchWherePhotonsStart) {
  for (const char* edge : {"left", "right", "front", "back"}) {
    const Scene scene =
        scene_of(kPlate + "reflectors: {" + edge + ": {gap_mm: 0.1}}, sources: [{kind: led_row, edge: " + edge +
                 ", count: 2, pitch_mm: 4, size_mm: [1, 0.2], gap_mm: 0.1}]");
    const Surface& surface = scene.optics[0].surfaces[6];
    core::PhotonRng rng({1, 0, 0}, 0);
    for (int i = 0; i < 200; ++i) {
      const core::Vec3 p = scene.spec.sources[0]->emit(rng).position;
      bool inside = false;
      for (const SurfaceWindow& w : surface.windows) {
        inside = inside || (surface.x.dot(p) >= w.min_x && surface.x.dot(p) <= w.max_x && surface.y.dot(p) >= w.min_y &&
                            surface.y.dot(p) <= w.max_y);
      }
      EXPECT_TRUE(inside) << edge;
    }
  }
}

}  // namespace
}  // namespace evenglow::tests
