#include "tracer/transport/planar_stack_walk.h"

#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;
using core::Vec3;
using StackWalk = PlanarStackWalk<MeridianLight>;

/// A plate of 20 x 10 x 2 mm, 0.5 mm above an ideal mirror; `above`: the films.
struct Stack {
  Scene scene;
  DensityField density = initial_density(scene.spec);
  PlanarScene layout = *PlanarScene::of(scene);
  PhotonHistory history{scene, density};
  PlanarPlate plate = *PlanarPlate::of(scene, layout, 0);
  PlanarLayers layers{scene, layout, plate, 0};
  PlanarPlateState<MeridianLight> state{plate};
  StackWalk walk{state, layers, history, scene};
  StackWalk::Walk photon;
  PlanarProgress progress;
  core::PhotonRng rng{{1, 0, 0}, 0};
  BatchSums sums{scene};

  explicit Stack(const std::string& above)
      : scene(scene_of("light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 2}, sources: [{kind: "
                       "lambertian_face, face: left}], reflectors: {bottom: {kind: mirror, reflectance: 1, gap_mm: "
                       "0.5}}" +
                       above)) {
    photon.optical_depth = 1e9;
  }
  StackWalk::End run(int face, double x, const Vec3& k) {
    state.x = x;
    state.y = 5.0;
    state.z = plate.planes[static_cast<std::size_t>(face)];
    state.light = MeridianLight(core::StokesVector::linear(1.0, 0.4, core::PolarizationFrame::any(k)));
    return walk.run(face, photon, progress, rng, sums);
  }
};

TEST(PlanarStackWalk, MirrorBelowThePlate) {
  Stack stack("");
  ASSERT_EQ(stack.run(4, 3.0, Vec3(0.6, 0.0, -0.8)), StackWalk::End::kAtPlate);
  EXPECT_EQ(stack.walk.side(), 4);
  EXPECT_NEAR(stack.state.x, 3.0 + 2 * 0.5 * 0.75, 1e-12);
  EXPECT_EQ(stack.state.z, 0.0);
  EXPECT_NEAR(stack.walk.distance(), 0.5 / 0.8, 1e-12);
  EXPECT_EQ(stack.progress.events, 2);
  // As OpaqueReflector does it: Q kept in the tangential count, U and V of the other sign.
  const auto before =
      MeridianLight(core::StokesVector::linear(1.0, 0.4, core::PolarizationFrame::any({0.6, 0.0, -0.8})));
  EXPECT_NEAR(stack.state.light.Q, before.Q, 1e-12);
  EXPECT_NEAR(stack.state.light.U, -before.U, 1e-12);
}

TEST(PlanarStackWalk, LeavesOtherFlightsToOthers) {
  Stack stack("");
  ASSERT_EQ(stack.run(4, 19.9, Vec3(0.6, 0.0, -0.8)), StackWalk::End::kElsewhere);
  EXPECT_EQ(stack.progress.events, 0);
  EXPECT_EQ(stack.photon.photon.body, -1);
  EXPECT_EQ(stack.photon.photon.quad, stack.plate.quads[4]);
  EXPECT_NEAR(stack.photon.photon.position.x(), 19.9, 1e-12);
  EXPECT_NEAR(stack.photon.photon.light.frame.k.x(), 0.6, 1e-12);
}

TEST(PlanarStackWalk, EscapesFromTheLastLayer) {
  Stack bare(""), under_films(", films: [{kind: bef}, {kind: lpp}]");
  EXPECT_EQ(bare.run(5, 3.0, Vec3(0.6, 0.0, 0.8)), StackWalk::End::kEnded);
  EXPECT_EQ(bare.progress.events, 1);
  int ended = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto end = under_films.run(5, 3.0 + 0.01 * i, Vec3(0.1, 0.7, std::sqrt(0.5)));
    ended += end == StackWalk::End::kEnded ? 1 : 0;
    if (end == StackWalk::End::kAtPlate) {
      EXPECT_EQ(under_films.walk.side(), 5);
    }
  }
  EXPECT_GT(ended, 200);
  // What ended has been absorbed or has left by the top.
  const auto& energy = under_films.sums.energy;
  EXPECT_EQ(std::accumulate(energy.begin(), energy.end(), 0.0), static_cast<double>(ended));
}

}  // namespace
}  // namespace evenglow::tests
