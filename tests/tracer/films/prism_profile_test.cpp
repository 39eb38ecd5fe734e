#include "tracer/films/prism_profile.h"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kRad = core::kRadPerDeg;

/// Height of the film at y from a tip, written down anew: the lower of facets and tip.
double surface_height(const PrismProfile::Shape& s, double y) {
  const double slope = 1.0 / std::tan(0.5 * s.apex);
  const double facet = (0.5 * s.pitch - std::abs(y)) * slope;
  const double half_flat = 0.5 * s.tip_flat;
  if (s.tip_flat > 0.0) return std::min(facet, (0.5 * s.pitch - half_flat) * slope);
  const double reach = s.tip_radius * std::cos(0.5 * s.apex);
  if (std::abs(y) >= reach) return facet;
  const double center = (0.5 * s.pitch - reach) * slope - s.tip_radius * std::sin(0.5 * s.apex);
  return center + std::sqrt(s.tip_radius * s.tip_radius - y * y);
}

const PrismProfile::Shape kShapes[] = {{1.0, 90 * kRad, 0.0, 0.0},  {1.0, 90 * kRad, 0.2, 0.0},
                                       {1.0, 90 * kRad, 0.0, 0.16}, {2.0, 60 * kRad, 0.0, 0.5},
                                       {0.5, 130 * kRad, 0.1, 0.0}, {1.0, 40 * kRad, 0.0, 0.0}};

TEST(PrismProfile, Heights) {
  EXPECT_NEAR(PrismProfile({0.05, 90 * kRad, 0.0, 0.0}).height(), 0.025, 1e-15);
  EXPECT_NEAR(PrismProfile({0.05, 90 * kRad, 0.01, 0.0}).height(), 0.02, 1e-15);
  // A circle of radius r between the facets of a right angle takes (sqrt 2 - 1) r off the tip.
  EXPECT_NEAR(PrismProfile({0.05, 90 * kRad, 0.0, 0.008}).height(), 0.025 - (std::sqrt(2.0) - 1.0) * 0.008, 1e-15);
  for (const auto& s : kShapes) EXPECT_NEAR(PrismProfile(s).height(), surface_height(s, 0.0), 1e-14);
}

TEST(PrismProfile, NoTipWiderThanThePrism) {
  EXPECT_THROW(PrismProfile({1.0, 90 * kRad, 1.0, 0.0}), core::Error);
  EXPECT_THROW(PrismProfile({1.0, 90 * kRad, 0.0, 0.71}), core::Error);
  EXPECT_THROW(PrismProfile({1.0, 90 * kRad, 0.1, 0.1}), core::Error);
  EXPECT_THROW(PrismProfile({1.0, core::kPi, 0.0, 0.0}), core::Error);
}

/// Random rays: the hit lies on the border, the way to it on the right side of the border, the normal against the ray.
class Rays {
 public:
  explicit Rays(const PrismProfile::Shape& shape) : shape_(shape), profile_(shape) {}

  void run(bool inside) {
    int hits[5] = {};
    for (int i = 0; i < 20'000; ++i) {
      PrismPoint from;
      double gap = 0.0;
      do {
        from = {uniform(-0.5, 0.5) * shape_.pitch, uniform(0.0, profile_.height())};
        gap = from.z - height(from.y, inside);
      } while (inside ? gap >= 0.0 : gap <= 0.0);
      const double a = uniform(-core::kPi, core::kPi);
      const double dy = std::sin(a), dz = std::cos(a);
      const PrismHit hit =
          inside ? profile_.inside(from, dy, dz, PrismPart::kNone) : profile_.outside(from, dy, dz, PrismPart::kNone);
      ++hits[static_cast<int>(hit.part)];
      check(from, dy, dz, hit, inside);
      if (testing::Test::HasFailure()) return;
    }
    EXPECT_EQ(hits[0], 0);
    for (const PrismPart part : {PrismPart::kRight, PrismPart::kLeft, PrismPart::kOpen}) {
      EXPECT_GT(hits[static_cast<int>(part)], 1000);
    }
    const bool tip_is_met = inside ? shape_.tip_flat + shape_.tip_radius > 0.0 : shape_.tip_radius > 0.0;
    EXPECT_EQ(hits[static_cast<int>(PrismPart::kTip)] > 0, tip_is_met);
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<double>(a, b)(random_); }
  double height(double y, bool inside) const {
    return surface_height(shape_, inside ? y : profile_.wrapped(y - 0.5 * shape_.pitch));
  }
  void check(const PrismPoint& from, double dy, double dz, const PrismHit& hit, bool inside) const {
    ASSERT_GE(hit.distance, 0.0);
    ASSERT_NEAR(from.y + hit.distance * dy, hit.point.y, 1e-9);
    ASSERT_NEAR(from.z + hit.distance * dz, hit.point.z, 1e-9);
    for (int j = 1; j < 20; ++j) {
      const double t = hit.distance * j / 20.0;
      const double gap = from.z + t * dz - height(from.y + t * dy, inside);
      ASSERT_TRUE(inside ? gap < 1e-9 : gap > -1e-9) << j;
    }
    if (hit.part == PrismPart::kOpen) {
      ASSERT_EQ(hit.point.z, inside ? 0.0 : profile_.height());
      return;
    }
    ASSERT_NEAR(hit.point.z, height(hit.point.y, inside), 1e-9);
    ASSERT_NEAR(std::hypot(hit.normal_y, hit.normal_z), 1.0, 1e-12);
    const double slope = hit.normal_y * dy + hit.normal_z * dz;
    ASSERT_TRUE(inside ? slope > 0.0 : slope < 0.0);
    // The normal is that of the border: the surface falls off on both sides of the tangent by second order only.
    const double e = 1e-6;
    const double y = hit.point.y;
    if (std::abs(profile_.wrapped(y - 0.5 * shape_.pitch)) < 1e-4 || std::abs(profile_.wrapped(y)) < 1e-4) return;
    const double tilt = (height(y + e, inside) - height(y - e, inside)) / (2.0 * e);
    const double corner = inside ? y : profile_.wrapped(y - 0.5 * shape_.pitch);
    if (std::abs(std::abs(corner) - 0.5 * shape_.tip_flat) < 1e-4) return;
    ASSERT_NEAR(-hit.normal_y / hit.normal_z, tilt, 1e-3);
  }

  PrismProfile::Shape shape_;
  PrismProfile profile_;
  std::mt19937_64 random_{7};
};

TEST(PrismProfile, RaysInsideMeetTheBorder) {
  for (const auto& shape : kShapes) Rays(shape).run(true);
}

TEST(PrismProfile, RaysOutsideMeetTheBorder) {
  for (const auto& shape : kShapes) Rays(shape).run(false);
}

TEST(PrismProfile, RaysFromAboveMeetTheFlatTip) {
  const PrismProfile profile({1.0, 90 * kRad, 0.2, 0.0});
  const PrismHit on_tip = profile.outside({0.45, profile.height()}, 0.1, -0.9, PrismPart::kNone);
  EXPECT_EQ(on_tip.part, PrismPart::kTip);
  EXPECT_EQ(on_tip.normal_z, 1.0);
  EXPECT_NEAR(profile.from_groove_to_prism(on_tip.point, on_tip.normal_y).y, -0.05, 1e-12);
  EXPECT_EQ(profile.outside({0.35, profile.height()}, 0.1, -0.9, PrismPart::kNone).part, PrismPart::kLeft);
  EXPECT_EQ(profile.outside(on_tip.point, 0.1, 0.9, PrismPart::kTip).part, PrismPart::kOpen);
}

TEST(PrismProfile, TheTwoCountsOfAPointFitTogether) {
  const PrismProfile profile({1.0, 90 * kRad, 0.0, 0.0});
  EXPECT_NEAR(profile.from_prism_to_groove({0.3, 0.2}, 0.7).y, -0.2, 1e-15);
  EXPECT_NEAR(profile.from_prism_to_groove({-0.3, 0.2}, -0.7).y, 0.2, 1e-15);
  EXPECT_NEAR(profile.from_groove_to_prism({-0.2, 0.2}, 0.7).y, 0.3, 1e-15);
  EXPECT_NEAR(profile.from_groove_to_prism({0.2, 0.2}, -0.7).y, -0.3, 1e-15);
  EXPECT_NEAR(profile.wrapped(3.4), 0.4, 1e-12);
  EXPECT_NEAR(profile.wrapped(-2.6), 0.4, 1e-12);
}

}  // namespace
}  // namespace evenglow::tracer
