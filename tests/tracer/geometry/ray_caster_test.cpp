#include "tracer/geometry/ray_caster.h"

#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::tracer {
namespace {

using core::Vec3;

std::vector<Quad> sides_of(const Box& box) {
  std::vector<Quad> quads;
  for (int i = 0; i < kSides; ++i) quads.push_back(side_of(box, static_cast<Side>(i)));
  return quads;
}

const Box kPlate{{0.0, 0.0, 0.0}, {140.0, 66.0, 0.6}};

TEST(RayCaster, HitsAreDoublePrecision) {
  const RayCaster caster(sides_of(kPlate));
  const Vec3 origin(70.123456789012, 33.987654321098, 0.3);
  const Vec3 k = Vec3(0.9, 0.3, 0.02).normalized();
  const RayHit hit = caster.nearest(origin, k, -1);
  ASSERT_EQ(hit.quad, static_cast<int>(Side::kTop));
  const double t = 0.3 / k.z();
  EXPECT_NEAR(hit.distance, t, 1e-12);
  EXPECT_NEAR((hit.position - (origin + t * k)).norm(), 0.0, 1e-11);
}

TEST(RayCaster, MissAndEmptyMesh) {
  EXPECT_EQ(RayCaster(sides_of(kPlate)).nearest({0, 0, 5}, Vec3::UnitZ(), -1).quad, -1);
  EXPECT_EQ(RayCaster({}).nearest({0, 0, 5}, Vec3::UnitZ(), -1).quad, -1);
  EXPECT_THROW(RayCaster({Quad{Vec3::Zero(), Vec3::UnitX(), Vec3::UnitX()}}), core::Error);
}

TEST(RayCaster, SkipsTheQuadThatTheRayLeaves) {
  std::vector<Quad> quads = sides_of(kPlate);
  quads.push_back({{0, 0, 2}, {140, 0, 0}, {0, 66, 0}});
  const RayCaster caster(quads);
  const int top = static_cast<int>(Side::kTop);
  EXPECT_EQ(caster.nearest({5, 5, 0.6}, Vec3::UnitZ(), top).quad, 6);
  EXPECT_EQ(caster.nearest({5, 5, 0.1}, Vec3::UnitZ(), top).quad, 6);
}

/// A long walk in a closed box of mirrors: never a miss, never outside, every path length as by unfolding. Single
/// precision alone leaks here.
TEST(RayCaster, ClosedBoxDoesNotLeak) {
  const RayCaster caster(sides_of(kPlate));
  std::mt19937_64 generator(1);
  std::uniform_real_distribution<double> u;
  std::normal_distribution<double> normal;
  for (int walk = 0; walk < 200; ++walk) {
    Vec3 p(140.0 * u(generator), 66.0 * u(generator), 0.6 * u(generator));
    Vec3 k = Vec3(normal(generator), normal(generator), normal(generator)).normalized();
    const Vec3 start = p, start_k = k;
    double way = 0.0;
    int quad = -1;
    for (int i = 0; i < 300; ++i) {
      RayHit hit = caster.nearest(p, k, quad);
      if (hit.quad < 0 || outward(static_cast<Side>(hit.quad)).dot(k) <= 0.0) {
        hit =
            caster.nearest_exact(p, k, [&](int q) { return q != quad && outward(static_cast<Side>(q)).dot(k) > 0.0; });
      }
      ASSERT_GE(hit.quad, 0);
      ASSERT_TRUE(kPlate.contains(hit.position));
      way += hit.distance;
      p = hit.position;
      quad = hit.quad;
      k[quad / 2] = -k[quad / 2];
    }
    for (int axis = 0; axis < 3; ++axis) {
      const double size = kPlate.max[axis];
      const double unfolded = start[axis] + way * start_k[axis];
      const double folded = std::abs(std::remainder(unfolded, 2.0 * size));
      EXPECT_NEAR(p[axis], folded, 1e-6) << axis;
    }
  }
}

/// Next to a wall that single precision cannot tell from the origin, but going away from it: the wall is not met again,
/// or a photon would be trapped in the corner of two mirrors.
TEST(RayCaster, WhatLiesBehindIsNotMet) {
  const Box room{{-0.001, -0.001, -0.05}, {2000.001, 1000.001, 0.05}};
  const RayCaster caster(sides_of(room));
  const Vec3 origin(919.091808205, 1000.00097229, 0.05);
  const Vec3 k = Vec3(-0.197242984, -0.432380279, -0.879853681).normalized();
  EXPECT_EQ(caster.nearest(origin, k, static_cast<int>(Side::kTop)).quad, static_cast<int>(Side::kBottom));
}

TEST(RayCaster, ExactSearchAgreesAndKeepsToTheAllowed) {
  const RayCaster caster(sides_of(kPlate));
  std::mt19937_64 generator(9);
  std::uniform_real_distribution<double> u;
  std::normal_distribution<double> normal;
  for (int i = 0; i < 1000; ++i) {
    const Vec3 p(10.0 + 100.0 * u(generator), 10.0 + 40.0 * u(generator), 0.1 + 0.4 * u(generator));
    const Vec3 k = Vec3(normal(generator), normal(generator), normal(generator)).normalized();
    const RayHit fast = caster.nearest(p, k, -1);
    const RayHit slow = caster.nearest_exact(p, k, [](int) { return true; });
    EXPECT_EQ(fast.quad, slow.quad);
    EXPECT_EQ(fast.position, slow.position);
  }
  EXPECT_EQ(caster.nearest_exact({1, 1, 0.3}, Vec3::UnitZ(), [](int q) { return q == 0; }).quad, -1);
  // A ray that starts on a face by rounding still meets it.
  EXPECT_EQ(caster.nearest_exact({1, 1, 0.6 + 5e-8}, Vec3::UnitZ(), [](int) { return true; }).quad, 5);
}

}  // namespace
}  // namespace evenglow::tracer
