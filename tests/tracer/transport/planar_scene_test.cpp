#include "tracer/transport/planar_scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"
#include "tracer/transport/photon_history.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tests {
namespace {

using namespace tracer;
using ::testing::HasSubstr;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}, ";
const std::string kLit = "sources: [{kind: lambertian_face, face: left}]";
const std::string kReflectors =
    ", reflectors: {bottom: {gap_mm: 0.1}, left: {gap_mm: 0.05}, right: {kind: mirror}, front: {gap_mm: 0.2}}";

/// How often the flights of the general path of `photons` photons end otherwise than in closed form; `unknown`: left to
/// the general search.
struct Count {
  int flights = 0, other = 0, unknown = 0;
};

Count compare_flights(const std::string& backlight, std::uint64_t photons) {
  const Scene scene = scene_of(backlight);
  const DensityField density = initial_density(scene.spec);
  const PhotonHistory general(scene, density);
  std::string reason;
  const auto layers = PlanarScene::of(scene, &reason);
  Count count;
  if (!layers) {
    ADD_FAILURE() << reason;
    return count;
  }
  BatchSums sums(scene);
  for (std::uint64_t i = 0; i < photons; ++i) {
    core::PhotonRng rng({1, 0, 0}, i);
    auto walk = general.start(rng);
    for (bool alive = true; alive;) {
      const auto hit = layers->next_hit(walk.photon);
      const int before = walk.photon.quad;
      alive = general.step(walk, rng, sums);
      ++count.flights;
      if (!hit) {
        ++count.unknown;
        continue;
      }
      if (!alive || walk.photon.quad < 0 || before < 0) continue;  // ended, or scattered in the bulk
      const bool same = hit->quad == walk.photon.quad && (hit->position - walk.photon.position).norm() < 1e-6;
      if (!same) ++count.other;
    }
  }
  return count;
}

TEST(PlanarScene, FlightsEndWhereRayTracingEndsThem) {
  for (const std::string& films :
       {std::string(""), std::string(", films: [{kind: diffuser}, {kind: sheet, thickness_mm: 0.5}, {kind: lpp}]")}) {
    const Count count =
        compare_flights(kPlate + "microstructure: {cells: [4, 2], density: 0.2}, " + kLit + kReflectors + films, 2000);
    EXPECT_GT(count.flights, 20'000);
    // At an edge single precision may decide otherwise.
    EXPECT_LE(count.other, count.flights / 10'000);
    EXPECT_EQ(count.unknown, 0);
  }
}

TEST(PlanarScene, WithoutAPlate) {
  const Count count = compare_flights(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], "
      "reflectors: {bottom: {gap_mm: 3}, left: {kind: mirror}}, films: [{kind: diffuser}, {kind: sheet}]",
      2000);
  EXPECT_LE(count.other, count.flights / 10'000);
  EXPECT_EQ(count.unknown, 0);
}

/// Where a source stands free in the room beside the plate, or light begins outside, the general search is asked.
TEST(PlanarScene, FreeSourcesAreLeftToTheGeneralSearch) {
  const Count leds = compare_flights(
      kPlate + "sources: [{kind: led_row, count: 2, gap_mm: 0.1}], reflectors: {left: {gap_mm: 0.3}, bottom: {}}",
      2000);
  EXPECT_LE(leds.other, 2);
  EXPECT_GT(leds.unknown, 0);
  EXPECT_LT(leds.unknown, leds.flights / 2);
  const Count beam = compare_flights(kPlate + "sources: [{kind: beam, face: top, gap_mm: 1}]", 500);
  EXPECT_EQ(beam.other, 0);
  EXPECT_EQ(beam.unknown, 500);
}

std::string refusal_of(const std::string& backlight) {
  std::string reason;
  EXPECT_FALSE(PlanarScene::of(scene_of(backlight), &reason));
  return reason;
}

TEST(PlanarScene, SaysWhyASceneIsNotPlanar) {
  EXPECT_THAT(
      refusal_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, end_thickness_mm: 1}, " + kLit),
      HasSubstr("a face of light_guide_plate is neither parallel nor square to the layers"));
  EXPECT_THAT(refusal_of("size: {length_mm: 20, width_mm: 10}, sources: [{kind: beam}]"),
              HasSubstr("neither a plate nor a film"));
}

TEST(TracePath, PlanarIsAFaultWhereItCannotBe) {
  const Scene wedge =
      scene_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, end_thickness_mm: 1}, " + kLit);
  const Scene flat = scene_of(kPlate + kLit);
  EXPECT_TRUE(takes_planar_path(flat, TracePath::kAuto));
  EXPECT_TRUE(takes_planar_path(flat, TracePath::kPlanar));
  EXPECT_FALSE(takes_planar_path(flat, TracePath::kGeneral));
  EXPECT_FALSE(takes_planar_path(wedge, TracePath::kAuto));
  try {
    takes_planar_path(wedge, TracePath::kPlanar);
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("trace.path: planar is for parallel layers over a flat plate"));
    EXPECT_THAT(error.what(), HasSubstr("light_guide_plate"));
  }
}

}  // namespace
}  // namespace evenglow::tests
