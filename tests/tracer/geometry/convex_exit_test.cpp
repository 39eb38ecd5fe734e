#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/math/sampling.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/geometry/ray_caster.h"

namespace evenglow::tests {
namespace {

using core::Vec3;
using tracer::RayHit;

std::vector<tracer::Quad> box_faces(const tracer::Box& box) {
  std::vector<tracer::Quad> quads;
  for (int i = 0; i < tracer::kSides; ++i) quads.push_back(tracer::side_of(box, static_cast<tracer::Side>(i)));
  return quads;
}

Vec3 isotropic(core::PhotonRng& rng) {
  const double z = 2.0 * rng.uniform() - 1.0;
  const double phi = 2.0 * core::kPi * rng.uniform();
  const double r = std::sqrt(1.0 - z * z);
  return {r * std::cos(phi), r * std::sin(phi), z};
}

class ConvexExit : public ::testing::Test {
 protected:
  const tracer::Box box_{Vec3(0, 0, 0), Vec3(100, 60, 3)};
  const tracer::RayCaster caster_{box_faces(box_)};
  const std::vector<int> faces_{0, 1, 2, 3, 4, 5};
};

TEST_F(ConvexExit, IsWhatTheExhaustiveSearchFinds) {
  core::PhotonRng rng({1, 0, 0}, 0);
  for (int i = 0; i < 20000; ++i) {
    const Vec3 origin(100 * rng.uniform(), 60 * rng.uniform(), 3 * rng.uniform());
    const Vec3 k = isotropic(rng);
    const RayHit exit = caster_.exit_of(faces_, origin, k, -1);
    const RayHit reference = caster_.nearest_exact(origin, k, [](int) { return true; });
    ASSERT_EQ(exit.quad, reference.quad);
    ASSERT_DOUBLE_EQ(exit.distance, reference.distance);
    ASSERT_LT((exit.position - (origin + exit.distance * k)).norm(), 1e-11);
  }
}

TEST_F(ConvexExit, FindsAFaceFromEveryCorner) {
  core::PhotonRng rng({1, 0, 0}, 1);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 corner(i & 1 ? 100 : 0, i & 2 ? 60 : 0, i & 4 ? 3 : 0);
    for (int face = 0; face < tracer::kSides; ++face) {
      // A ray that leaves `face` inwards, as after a reflection there.
      Vec3 k = isotropic(rng);
      const Vec3 normal = tracer::outward(static_cast<tracer::Side>(face));
      if (k.dot(normal) > 0.0) k -= 2.0 * k.dot(normal) * normal;
      const RayHit exit = caster_.exit_of(faces_, corner, k, face);
      ASSERT_GE(exit.quad, 0);
      ASSERT_NE(exit.quad, face);
      ASSERT_GE(exit.distance, 0.0);
      ASSERT_TRUE(box_.contains(exit.position));
    }
  }
}

TEST_F(ConvexExit, KnowsOnlyTheFacesItIsGiven) {
  const std::vector<int> bottom_and_top{4, 5};
  EXPECT_EQ(caster_.exit_of(bottom_and_top, {50, 30, 1}, Vec3(0.6, 0, 0.8), -1).quad, 5);
  EXPECT_EQ(caster_.exit_of(bottom_and_top, {50, 30, 1}, Vec3::UnitX(), -1).quad, -1);
}

}  // namespace
}  // namespace evenglow::tests
