#include "tracer/transport/wavefront_outside.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

/// A backlight with all that a photon outside the plate needs.
struct Stage {
  explicit Stage(const std::string& yaml)
      : scene(scene_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2, refractive_index: 1.5}, " +
                       yaml + ", receivers: [{kind: luminance, estimator: counting}]")),
        density(initial_density(scene.spec)),
        layout(*PlanarScene::of(scene)),
        plate(*PlanarPlate::of(scene, layout, 0)),
        cells(density),
        history(scene, density),
        outside(scene, layout, history, plate, cells),
        sums(scene) {
    sums.viewer.seed({}, 0);
  }

  Scene scene;
  DensityField density;
  PlanarScene layout;
  PlanarPlate plate;
  PlanarCells cells;
  PhotonHistory history;
  WavefrontOutside outside;
  BatchSums sums;
  core::PhotonRng rng{{1, 0, 0}, 7};
  WavefrontOutside::Walk walk;
};

TEST(WavefrontOutside, BringsLightOfASourceToTheWallInFrontOfIt) {
  Stage stage("sources: [{kind: led_row, edge: right, count: 2, gap_mm: 0.05}], reflectors: {right: {gap_mm: 0.1}}");
  int straight = 0;
  for (std::uint64_t photon = 0; photon < 500; ++photon) {
    core::PhotonRng rng({1, 0, 0}, photon);
    int side = -1;
    if (!stage.outside.start(stage.walk, side, rng, stage.sums)) continue;
    if (side < 0) continue;
    ++straight;
    EXPECT_EQ(side, static_cast<int>(Side::kRight));
    const auto& state = stage.outside.state();
    EXPECT_EQ(state.x, 20.0);
    EXPECT_LT(state.light.kx, 0.0);
    EXPECT_TRUE(state.z > 0.0 && state.z < 2.0 && state.y > 0.0 && state.y < 10.0);
    EXPECT_EQ(stage.outside.progress().events, 1);
    EXPECT_EQ(stage.walk.photon.body, stage.plate.body);
  }
  EXPECT_GT(straight, 400);
}

/// A source behind another one, or one that is not before a smooth wall, is followed by the scalar path.
TEST(WavefrontOutside, DoesNotGuessWhereSomethingMayStandBetween) {
  Stage behind(
      "sources: [{kind: led_row, edge: left, count: 1, gap_mm: 0.05}, {kind: led_row, edge: left, count: 2, "
      "pitch_mm: 6, gap_mm: 0.5}]");
  Stage serrated("sources: [{kind: led_row, edge: left, count: 1, gap_mm: 0.05}]");
  serrated.plate.smooth[0] = false;
  for (std::uint64_t photon = 0; photon < 200; ++photon) {
    int side = -1;
    core::PhotonRng rng({1, 0, 0}, photon);
    if (behind.outside.start(behind.walk, side, rng, behind.sums) && side >= 0) {
      EXPECT_NEAR(behind.walk.photon.position.x(), -0.05, 1e-9);
    }
    core::PhotonRng again({1, 0, 0}, photon);
    const bool lives = serrated.outside.start(serrated.walk, side, again, serrated.sums);
    EXPECT_TRUE(!lives || side == -1);
  }
}

TEST(WavefrontOutside, CountsWhatEscapesAndWhatIsAbsorbed) {
  Stage stage("sources: [{kind: lambertian_face, face: left}], reflectors: {bottom: {}}");
  stage.walk.weight = core::Vec3::Ones();
  stage.outside.escape({10.0, 5.0, 2.0}, {0.0, 0.0, 1.0}, 4, stage.walk, stage.sums);
  EXPECT_EQ(stage.sums.energy[static_cast<std::size_t>(Side::kTop)], 1.0);
  EXPECT_GT(std::accumulate(stage.sums.luminance.begin(), stage.sums.luminance.end(), 0.0), 0.0);
  stage.outside.absorb(stage.plate.part, 3, stage.walk, stage.sums);
  EXPECT_EQ(stage.sums.energy[stage.scene.energy.absorbed_bin(stage.plate.part)], 1.0);
  EXPECT_EQ(stage.sums.events[0], 7.0);
}

/// Light that has left the top goes to the film above; what is stuck is given up.
TEST(WavefrontOutside, GoesOnFromWhereTheKernelLeftOff) {
  Stage stage(
      "sources: [{kind: lambertian_face, face: left}], films: [{kind: diffuser, transmittance: 0, reflectance: "
      "1}]");
  auto& state = stage.outside.state();
  state.x = 10.0;
  state.y = 5.0;
  state.z = 2.0;
  state.light.kz = 1.0;
  ASSERT_TRUE(stage.outside.go_on(LaneExit::kTop, 0, stage.walk, stage.rng, stage.sums));
  EXPECT_EQ(state.z, 2.0);
  EXPECT_LT(state.light.kz, 0.0);
  EXPECT_GE(stage.outside.progress().events, 2);

  EXPECT_FALSE(stage.outside.go_on(LaneExit::kStuck, 0, stage.walk, stage.rng, stage.sums));
  EXPECT_EQ(stage.sums.energy[stage.scene.energy.lost_bin(LossReason::kStuck)], 1.0);
}

}  // namespace
}  // namespace evenglow::tests
