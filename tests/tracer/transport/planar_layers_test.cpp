#include "tracer/transport/planar_layers.h"

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;
using Kind = PlanarLayer::Kind;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}, ";
const std::string kLit = "sources: [{kind: lambertian_face, face: left}]";

PlanarLayers layers_of(const std::string& backlight) {
  const Scene scene = scene_of(backlight);
  const auto layout = PlanarScene::of(scene);
  return PlanarLayers(scene, *layout, *PlanarPlate::of(scene, *layout, 0), 0);
}

TEST(PlanarLayers, KnowsEachKindFromBelow) {
  const Scene scene = scene_of(kPlate +
                               "reflectors: {bottom: {gap_mm: 0.1}}, films: [{kind: diffuser}, {kind: bef}, "
                               "{kind: sheet, thickness_mm: 0.3}, {kind: dbef}], " +
                               kLit);
  const auto layout = PlanarScene::of(scene);
  const PlanarLayers layers(scene, *layout, *PlanarPlate::of(scene, *layout, 0), 0);
  ASSERT_EQ(layers.size(), 8u);
  const Kind kinds[] = {Kind::kReflector, Kind::kPlate, Kind::kPlate, Kind::kDiffuser,
                        Kind::kPrism,     Kind::kOther, Kind::kOther, Kind::kOther};
  const bool air[] = {true, false, true, true, true, false, true, false};
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(layers[i].kind, kinds[i]) << i;
    EXPECT_EQ(layers[i].air_above, air[i]) << i;
    EXPECT_EQ(layers[i].last, i == 7) << i;
    EXPECT_GT(layers[i].z, i > 0 ? layers[i - 1].z : -1.0) << i;
  }
  EXPECT_EQ(layers.plate_face(4), 1u);
  EXPECT_EQ(layers.plate_face(5), 2u);
  EXPECT_EQ(layers[1].z, 0.0);
  EXPECT_EQ(layers[2].z, 2.0);
  EXPECT_EQ(layers[0].z, -0.1);
}

TEST(PlanarLayers, BarePlate) {
  const PlanarLayers bare = layers_of(kPlate + kLit);
  ASSERT_EQ(bare.size(), 2u);
  EXPECT_TRUE(bare[1].last);
  EXPECT_FALSE(bare[1].air_above);
}

}  // namespace
}  // namespace evenglow::tests
