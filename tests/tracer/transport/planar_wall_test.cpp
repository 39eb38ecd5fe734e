#include "tracer/transport/planar_wall.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/plate_light.h"
#include "tracer/optics/dielectric_face.h"

/// Light through and at the side walls against the general smooth face, for every wall and both ways.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::StokesVector;
using core::Vec3;

constexpr double kIndex = 1.49;

/// Polarized light that runs outwards (or inwards) at a wall.
StokesVector light_at(int side, bool outwards, core::PhotonRng& rng) {
  Vec3 k = random_direction(rng);
  const int axis = side / 2;
  if ((k[axis] > 0.0) != ((side % 2 == 1) == outwards)) k[axis] = -k[axis];
  return polarized_light(k, rng);
}

/// What the general face makes of it, drawn until it is passed or reflected as asked for.
StokesVector by_general_face(const StokesVector& light, int side, bool outwards, bool passed, core::PhotonRng& rng) {
  const int axis = side / 2;
  const auto turn = [](const Vec3& v, int by) { return Vec3(v[by % 3], v[(1 + by) % 3], v[(2 + by) % 3]); };
  const int there = (axis + 1) % 3;
  const int back = (3 - there) % 3;
  const bool up = light.frame.k[axis] > 0.0;
  const DielectricFace face(up == outwards ? kIndex : 1.0, up == outwards ? 1.0 : kIndex);
  const StokesVector local{1.0, light.Q, light.U, light.V, {turn(light.frame.k, there), turn(light.frame.e1, there)}};
  while (true) {
    const StokesVector s = face.sample(local, rng)->light;
    if ((s.frame.k.z() * local.frame.k.z() > 0.0) != passed) continue;
    return {1.0, s.Q, s.U, s.V, {turn(s.frame.k, back), turn(s.frame.e1, back)}};
  }
}

void expect_same(const StokesVector& a, const StokesVector& b) {
  const StokesVector c = b.in_frame(a.frame.e1);
  EXPECT_LT((a.frame.k - b.frame.k).norm(), 1e-11);
  EXPECT_NEAR(a.Q, c.Q, 1e-10);
  EXPECT_NEAR(a.U, c.U, 1e-10);
  EXPECT_NEAR(a.V, c.V, 1e-10);
}

WallEnd at_wall(PlanarPlateState<MeridianLight>& state, int side, bool outwards, Photon& photon, core::PhotonRng& rng) {
  const auto met = [&](auto wall) {
    PlanarProgress progress;
    return outwards ? wall.from_inside(photon, progress, rng) : wall.from_outside(photon, rng);
  };
  return side < 2 ? met(PlanarWall<MeridianLight, true>(state, side))
                  : met(PlanarWall<MeridianLight, false>(state, side));
}

TEST(PlanarWall, SameLightAsTheGeneralFace) {
  const PlanarPlate plate = bare_plate(kIndex);
  core::PhotonRng rng({5, 0, 0}, 0);
  int passed_count = 0, kept_count = 0;
  for (int i = 0; i < 4000; ++i) {
    const int side = i % 4;
    const bool outwards = (i / 4) % 2 == 0;
    PlanarPlateState<MeridianLight> state(plate);
    Photon photon;
    photon.position = Vec3(2.0, 1.5, 1.0);
    photon.position[side / 2] = plate.planes[static_cast<std::size_t>(side)];
    const StokesVector light = photon.light = light_at(side, outwards, rng);
    state.load(photon);
    const WallEnd end = at_wall(state, side, outwards, photon, rng);
    ASSERT_NE(end, WallEnd::kAbsorbed);
    const bool inside = end == WallEnd::kInside;
    const bool passed = inside != outwards;
    ++(passed ? passed_count : kept_count);
    expect_same(inside ? state.light.stokes() : photon.light, by_general_face(light, side, outwards, passed, rng));
  }
  EXPECT_GT(passed_count, 1000);
  EXPECT_GT(kept_count, 500);
}

/// A lossless mirror behind the wall: all light comes back, mirrored, and its polarization is one of full degree.
TEST(PlanarWall, MirrorBehindTheWallGivesAllLightBack) {
  PlanarPlate plate = bare_plate(kIndex);
  plate.backings[1] = {{true, 1.0, 1.0, 0, 1.0}, 0.0, 9};
  core::PhotonRng rng({6, 0, 0}, 0);
  for (int i = 0; i < 500; ++i) {
    PlanarPlateState<MeridianLight> state(plate);
    Photon photon;
    photon.position = Vec3(4.0, 1.5, 1.0);
    photon.light = light_at(1, true, rng);
    const Vec3 k = photon.light.frame.k;
    state.load(photon);
    ASSERT_EQ(at_wall(state, 1, true, photon, rng), WallEnd::kInside);
    const StokesVector back = state.light.stokes();
    EXPECT_LT((back.frame.k - Vec3(-k.x(), k.y(), k.z())).norm(), 1e-14);
    EXPECT_NEAR(std::hypot(back.Q, back.U, back.V), 1.0, 1e-10);
  }
}

}  // namespace
}  // namespace evenglow::tests
