#include "tracer/wavefront/plate_kernel.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/montecarlo/photon_rng.h"
#include "tracer/transport/planar_light.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

/// Rounding of some hundred steps in single precision.
constexpr double kSingle = 2e-5;

/// 2 mm thick, without absorption.
PlateConstants bare_plate(double length, double width) {
  PlateConstants plate;
  plate.max_x = length;
  plate.max_y = width;
  plate.max_z = plate.height = 2.0;
  plate.per_height = 0.5;
  plate.per_absorption = 1e30;
  return plate;
}

/// A plate with all that the kernel knows.
PlateConstants plate_with_everything() {
  PlateConstants plate = bare_plate(30.0, 20.0);
  plate.absorption = 0.002;
  plate.per_absorption = 500.0;
  plate.part = 3.0;
  plate.pattern_side = 4;
  plate.dots = {1.0, 0.9, 0.2, 4.0, 0.0};
  plate.below = {1.0, 0.95, 0.1, 5.0, 0.1};
  plate.smooth = {1.0, 1.0, 1.0, 0.0};
  plate.all_smooth = false;
  plate.backing_known = {1.0, 1.0, 0.0, 0.0};
  plate.backing_reflectance = {0.9, 0.8, 0.0, 0.0};
  plate.backing_mirrored = {0.9, 0.1, 0.0, 0.0};
  plate.backing_part = {6.0, 7.0, 0.0, 0.0};
  plate.backing_gap = {0.1, 0.0, 0.0, 0.0};
  plate.per_x = plate.per_y = 0.5;
  plate.nx = 15;
  plate.ny = 10;
  plate.open.assign(150, 0.0F);
  for (std::size_t i = 0; i < 150; ++i) plate.open[i] = 1.0F - 0.003F * static_cast<float>(i);
  return plate;
}

PlateLanes random_lanes(std::uint64_t first) {
  PlateLanes lanes;
  for (std::size_t i = 0; i < kLanes; ++i) {
    core::PhotonRng rng({5, 0, 0}, first + i);
    lanes.x[i] = 30.0 * rng.uniform();
    lanes.y[i] = 20.0 * rng.uniform();
    lanes.z[i] = 2.0 * rng.uniform();
    lanes.kz[i] = 2.0 * rng.uniform() - 1.0;
    const double azimuth = 6.283185307179586 * rng.uniform();
    const double sine = std::sqrt(1.0 - lanes.kz[i] * lanes.kz[i]);
    lanes.kx[i] = sine * std::cos(azimuth);
    lanes.ky[i] = sine * std::sin(azimuth);
    lanes.I[i] = 1.0;
    lanes.Q[i] = 0.3;
    lanes.U[i] = 0.5;
    lanes.V[i] = -0.6;
    lanes.depth[i] = -std::log(rng.uniform());
    lanes.missed[i] = 1.0;
    lanes.fate[i] = rng.uniform();
    const auto words = core::lane_words({5, 0, 0}, first + i);
    for (std::size_t word = 0; word < 4; ++word) lanes.random[word][i] = words[word];
  }
  return lanes;
}

MeridianLight light_of(const PlateLanes& lanes, std::size_t i) {
  MeridianLight light;
  light.kx = lanes.kx[i];
  light.ky = lanes.ky[i];
  light.kz = lanes.kz[i];
  light.I = lanes.I[i];
  light.Q = lanes.Q[i];
  light.U = lanes.U[i];
  light.V = lanes.V[i];
  return light;
}

bool same(const PlateLanes& a, const PlateLanes& b) {
  return a.x == b.x && a.y == b.y && a.z == b.z && a.kx == b.kx && a.ky == b.ky && a.kz == b.kz && a.I == b.I &&
         a.Q == b.Q && a.U == b.U && a.V == b.V && a.depth == b.depth && a.missed == b.missed && a.fate == b.fate &&
         a.events == b.events && a.random == b.random && a.exit == b.exit && a.part == b.part && a.side == b.side;
}

/// Gives the widest instruction set back.
struct InstructionSet {
  explicit InstructionSet(std::int64_t set) { force_instruction_set(set); }
  ~InstructionSet() { force_instruction_set(0); }
  InstructionSet(const InstructionSet&) = delete;
  InstructionSet& operator=(const InstructionSet&) = delete;
};

/// 3200 photons until they have left the kernel, by every way that it knows.
std::vector<PlateLanes> stepped_to_the_end(const PlateConstants& plate) {
  std::vector<PlateLanes> groups;
  for (std::uint64_t i = 0; i < 200; ++i) groups.push_back(random_lanes(kLanes * i));
  for (int step = 0; step < 400; ++step) step_plate(plate, groups.data(), groups.size());
  return groups;
}

TEST(PlateKernel, GivesTheSameBitsByEveryInstructionSet) {
  const PlateConstants plate = plate_with_everything();
  const std::vector<PlateLanes> widest = stepped_to_the_end(plate);
  std::set<std::uint32_t> exits;
  for (const PlateLanes& group : widest) exits.insert(group.exit.begin(), group.exit.end());
  EXPECT_EQ(exits.count(static_cast<std::uint32_t>(LaneExit::kNone)), 0u);
  EXPECT_GE(exits.size(), 7u);
  std::set<std::string> names;
  for (const std::int64_t set : instruction_sets()) {
    const InstructionSet forced(set);
    names.insert(instruction_set_name(set));
    const std::vector<PlateLanes> groups = stepped_to_the_end(plate);
    for (std::size_t i = 0; i < groups.size(); ++i) {
      ASSERT_TRUE(same(groups[i], widest[i])) << instruction_set_name(set) << ", group " << i;
    }
  }
  EXPECT_GE(names.size(), 1u);
  RecordProperty("instruction_sets", static_cast<int>(names.size()));
}

TEST(PlateKernel, WhatALaneDoesDependsOnItsOwnStateAlone) {
  const PlateConstants plate = plate_with_everything();
  for (std::uint64_t first = 0; first < 400; first += kLanes) {
    PlateLanes together = random_lanes(first);
    PlateLanes alone = together;
    for (std::size_t i = 0; i < kLanes; ++i) {
      if (i != 2) alone.exit[i] = static_cast<std::uint32_t>(LaneExit::kEmpty);
    }
    for (int step = 0; step < 30; ++step) {
      step_plate(plate, &together, 1);
      step_plate(plate, &alone, 1);
      ASSERT_EQ(together.x[2], alone.x[2]);
      ASSERT_EQ(together.U[2], alone.U[2]);
      ASSERT_EQ(together.random[0][2], alone.random[0][2]);
      ASSERT_EQ(together.exit[2], alone.exit[2]);
    }
    EXPECT_EQ(alone.x[3], random_lanes(first).x[3]) << "an empty lane is left alone";
  }
}

/// Bare plate: place and light after one step from face to face up to a wall, and the wall's total reflection, against
/// the scalar `MeridianLight`, one reflection after the other.
TEST(PlateKernel, TotalReflectionsTurnTheLightAsTheScalarPathDoes) {
  PlateConstants plate = bare_plate(30.0, 20.0);
  plate.smooth = {1.0, 1.0, 1.0, 1.0};
  int walls = 0;
  for (std::uint64_t first = 0; first < 800; first += kLanes) {
    const PlateLanes before = random_lanes(first);
    PlateLanes after = before;
    step_plate(plate, &after, 1);
    for (std::size_t i = 0; i < kLanes; ++i) {
      MeridianLight light = light_of(before, i);
      const PlateFresnel face(std::abs(light.kz), plate.index, 1.0);
      if (!face.total || after.exit[i] != 0) continue;
      const bool x_wall = after.x[i] == 0.0 || after.x[i] == 30.0;
      const PlateFresnel wall(std::abs(x_wall ? light.kx : light.ky), plate.index, 1.0);
      if (!wall.total) continue;
      const double faces = after.events[i] - 1.0;
      for (int j = 0; j < static_cast<int>(faces); ++j) {
        light.turn_phase(face.phase_re, face.phase_im);
        light.kz = -light.kz;
      }
      double& kn = x_wall ? light.kx : light.ky;
      const WallTurn turn(kn, x_wall ? light.ky : light.kx, light.kz, x_wall ? 1.0 : -1.0);
      light.turn_frame(turn.cos2, turn.sin2);
      light.turn_phase(wall.phase_re, wall.phase_im);
      light.turn_frame(turn.cos2, turn.sin2);
      kn = -kn;
      EXPECT_NEAR(after.Q[i], light.Q, kSingle);
      EXPECT_NEAR(after.U[i], light.U, kSingle);
      EXPECT_NEAR(after.V[i], light.V, kSingle);
      EXPECT_EQ(after.kx[i], light.kx);
      EXPECT_EQ(after.ky[i], light.ky);
      EXPECT_EQ(after.kz[i], light.kz);
      EXPECT_GE(after.z[i], 0.0);
      EXPECT_LE(after.z[i], 2.0);
      ++walls;
    }
  }
  EXPECT_GT(walls, 100);
}

double distance(const MeridianLight& a, const MeridianLight& b) {
  return std::hypot(a.Q / a.I - b.Q / b.I, a.U / a.I - b.U / b.I, a.V / a.I - b.V / b.I) +
         std::hypot(a.kx - b.kx, a.ky - b.ky, a.kz - b.kz);
}

/// Light before a wall that lets it out to a perfect mirror which touches it: either the wall reflects it, or it passes
/// the wall twice. Both outcomes from the formulas of the scalar path.
TEST(PlateKernel, WallsAndMirrorsBehindThemKeepTheCountOfTheLight) {
  PlateConstants plate = bare_plate(30.0, 20.0);
  plate.smooth = plate.backing_known = plate.backing_reflectance = plate.backing_mirrored = {1.0, 1.0, 1.0, 1.0};
  int reflected = 0, mirrored = 0;
  for (std::uint64_t first = 0; first < 1600; first += kLanes) {
    PlateLanes before = random_lanes(first);
    for (std::size_t i = 0; i < kLanes; ++i) {  // in the wall's plane, so that no other face comes first
      const bool x_wall = i % 2 == 0;
      before.x[i] = x_wall ? 30.0 : 15.0;
      before.y[i] = x_wall ? 10.0 : 20.0;
      before.z[i] = 1.0;
      if (x_wall) before.kx[i] = std::abs(before.kx[i]);
      if (!x_wall) before.ky[i] = std::abs(before.ky[i]);
    }
    PlateLanes after = before;
    step_plate(plate, &after, 1);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool x_wall = i % 2 == 0;
      MeridianLight light = light_of(before, i);
      double& kn = x_wall ? light.kx : light.ky;
      const PlateFresnel wall(std::abs(kn), plate.index, 1.0);
      if (wall.total || after.exit[i] != 0) continue;
      const WallTurn turn(kn, x_wall ? light.ky : light.kx, light.kz, x_wall ? 1.0 : -1.0);
      light.turn_frame(turn.cos2, turn.sin2);
      kn = -kn;
      MeridianLight returned = light;
      ASSERT_TRUE(wall.reflects(returned, 0.0));  // the least of all numbers
      returned.turn_frame(turn.cos2, turn.sin2);
      wall.pass(light);
      light.mirror();
      wall.pass(light);
      light.turn_frame(turn.cos2, turn.sin2);
      const MeridianLight found = light_of(after, i);
      const bool by_wall = after.events[i] == 1.0;
      EXPECT_LT(distance(found, by_wall ? returned : light), kSingle);
      ++(by_wall ? reflected : mirrored);
    }
  }
  EXPECT_GT(reflected, 10);
  EXPECT_GT(mirrored, 200);
}

/// xoshiro128+ as its authors give it.
struct Xoshiro128 {
  std::array<std::uint32_t, 4> s;

  float uniform() {
    const std::uint32_t result = s[0] + s[3];
    const std::uint32_t shifted = s[1] << 9;
    s[2] ^= s[0];
    s[3] ^= s[1];
    s[1] ^= s[2];
    s[0] ^= s[3];
    s[2] ^= shifted;
    s[3] = std::rotl(s[3], 11);
    return (static_cast<float>(result >> 9) + 0.5F) * 0x1.0p-23F;
  }
};

/// The pattern as a perfect mirror, at each arrival: the light is turned as at an ideal mirror.
TEST(PlateKernel, MirrorsThatArePrintedKeepTheCountOfTheLight) {
  PlateConstants plate = bare_plate(1000.0, 1000.0);
  plate.smooth = {1.0, 1.0, 1.0, 1.0};
  plate.pattern_side = 4;
  plate.dots = {1.0, 1.0, 1.0, 0.0, 0.0};
  plate.open = {0.0F};
  for (std::uint64_t first = 0; first < 160; first += kLanes) {
    PlateLanes before = random_lanes(first);
    for (std::size_t i = 0; i < kLanes; ++i) {
      before.x[i] = before.y[i] = 500.0;
      before.kz[i] = -std::abs(before.kz[i]) - 0.01;
    }
    PlateLanes after = before;
    step_plate(plate, &after, 1);
    for (std::size_t i = 0; i < kLanes; ++i) {
      MeridianLight light = light_of(before, i);
      light.mirror();
      light.kz = -light.kz;
      EXPECT_EQ(distance(light_of(after, i), light), 0.0);
      EXPECT_EQ(after.z[i], 0.0);
      EXPECT_EQ(after.missed[i], 1.0);
      Xoshiro128 random{{before.random[0][i], before.random[1][i], before.random[2][i], before.random[3][i]}};
      EXPECT_EQ(after.fate[i], random.uniform());
      for (int drawn = 1; drawn < 4; ++drawn) random.uniform();
      for (std::size_t word = 0; word < 4; ++word) EXPECT_EQ(after.random[word][i], random.s[word]);
    }
  }
}

/// Cells that are either bare or full: the light meets the pattern at its first arrival at a full cell, found here by
/// going from arrival to arrival.
TEST(PlateKernel, MeetsThePatternInTheCellWhereItIs) {
  PlateConstants plate = plate_with_everything();
  plate.absorption = 0.0;
  plate.per_absorption = 1e30;
  plate.dots.known = 0.0;
  for (std::size_t i = 0; i < plate.open.size(); ++i) plate.open[i] = (i * i) % 7 == 2 ? 0.0F : 1.0F;
  int met = 0, passed = 0;
  for (std::uint64_t first = 0; first < 1600; first += kLanes) {
    const PlateLanes before = random_lanes(first);
    PlateLanes after = before;
    step_plate(plate, &after, 1);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const double kx = before.kx[i], ky = before.ky[i], slope = std::abs(before.kz[i]);
      if (1.5 * 1.5 * (1.0 - slope * slope) < 1.0) continue;  // not totally reflected
      const double to_x = (kx > 0.0 ? 30.0 - before.x[i] : before.x[i]) / std::abs(kx);
      const double to_y = (ky > 0.0 ? 20.0 - before.y[i] : before.y[i]) / std::abs(ky);
      double way = (before.kz[i] < 0.0 ? before.z[i] : 4.0 - before.z[i]) / slope;
      bool meets = false;
      double x = 0.0, y = 0.0;
      for (; way < std::min(to_x, to_y) && !meets; way += 4.0 / slope) {
        x = before.x[i] + kx * way;
        y = before.y[i] + ky * way;
        meets = plate.open[static_cast<std::size_t>(y / 2.0) * 15 + static_cast<std::size_t>(x / 2.0)] == 0.0;
      }
      ASSERT_EQ(after.exit[i] == static_cast<std::uint32_t>(LaneExit::kPattern), meets);
      if (meets) {
        EXPECT_NEAR(after.x[i], x, 1e-4);
        EXPECT_NEAR(after.y[i], y, 1e-4);
        EXPECT_EQ(after.z[i], 0.0);
        EXPECT_LT(after.kz[i], 0.0);
      }
      ++(meets ? met : passed);
    }
  }
  EXPECT_GT(met, 100);
  EXPECT_GT(passed, 100);
}

TEST(PlateKernel, LetsInNaturalLightByTheFresnelShareOfEachAngle) {
  PlateConstants plate;
  plate.max_x = plate.max_y = 10.0;
  plate.max_z = plate.height = 2.0;
  plate.smooth = {1.0, 1.0, 1.0, 1.0};
  const double cosine = 0.4;
  const PlateFresnel face(cosine, 1.0, plate.index);
  const double sums = face.p_sum * face.s_sum;
  const double share =
      1.0 - 0.5 * (face.p_reflected * face.p_reflected + face.s_reflected * face.s_reflected) / (sums * sums);
  double inside = 0.0;
  const std::uint64_t photons = 80'000;
  for (std::uint64_t first = 0; first < photons; first += kLanes) {
    PlateLanes lanes = random_lanes(first);
    for (std::size_t i = 0; i < kLanes; ++i) {
      lanes.exit[i] = static_cast<std::uint32_t>(LaneExit::kArrives);
      lanes.side[i] = 3.0;
      lanes.kx[i] = 0.0;
      lanes.ky[i] = -cosine;
      lanes.kz[i] = std::sqrt(1.0 - cosine * cosine);
    }
    enter_plate(plate, lanes);
    for (std::size_t i = 0; i < kLanes; ++i) {
      const bool in = lanes.exit[i] == 0;
      inside += in ? 1.0 : 0.0;
      EXPECT_EQ(lanes.exit[i], static_cast<std::uint32_t>(in ? LaneExit::kNone : LaneExit::kWall));
      EXPECT_NEAR(lanes.ky[i], in ? -face.cos_t : cosine, kSingle);
      EXPECT_EQ(lanes.V[i], 0.0);
    }
  }
  const double z = (inside - share * photons) / std::sqrt(share * (1.0 - share) * photons);
  EXPECT_LT(std::abs(z), 4.0);  // false alarm 6e-5
}

}  // namespace
}  // namespace evenglow::tests
