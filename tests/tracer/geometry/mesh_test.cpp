#include "tracer/geometry/mesh.h"

#include <random>
#include <string>

#include <gtest/gtest.h>

namespace evenglow::tracer {
namespace {

constexpr Side kAll[] = {Side::kLeft, Side::kRight, Side::kFront, Side::kBack, Side::kBottom, Side::kTop};
const Box kBox{{1.0, 2.0, 3.0}, {4.0, 6.0, 8.0}};

TEST(Mesh, SidesFaceOutAndLieInTheirPlanes) {
  for (const Side side : kAll) {
    const Quad quad = side_of(kBox, side);
    EXPECT_NEAR((quad.normal() - outward(side)).norm(), 0.0, 1e-15) << side_name(side);
    for (const core::Vec3& p : {quad.corner, core::Vec3(quad.corner + quad.u), core::Vec3(quad.corner + quad.v),
                                core::Vec3(quad.corner + quad.u + quad.v)}) {
      EXPECT_DOUBLE_EQ(p[axis_of(side)], kBox.plane(side));
      EXPECT_TRUE(kBox.contains(p));
    }
  }
}

TEST(Mesh, Names) {
  EXPECT_STREQ(side_name(Side::kLeft), "left");
  EXPECT_STREQ(side_name(Side::kTop), "top");
  EXPECT_EQ(axis_of(Side::kBack), 1);
  EXPECT_TRUE(is_upper(Side::kBack));
  EXPECT_FALSE(is_upper(Side::kBottom));
}

TEST(Box, ContainsItsBorder) {
  EXPECT_TRUE(kBox.contains(kBox.min));
  EXPECT_FALSE(kBox.contains({0.999, 3.0, 4.0}));
}

/// From inside: the face whose plane the ray reaches first, found by marching.
TEST(Box, ExitSideFromInside) {
  std::mt19937_64 generator(2);
  std::uniform_real_distribution<double> u(0.05, 0.95);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 2000; ++i) {
    const core::Vec3 p = kBox.min + core::Vec3(u(generator) * 3.0, u(generator) * 4.0, u(generator) * 5.0);
    const core::Vec3 k = core::Vec3(normal(generator), normal(generator), normal(generator)).normalized();
    const Side side = kBox.exit_side(p, k);
    const double t = (kBox.plane(side) - p[axis_of(side)]) / k[axis_of(side)];
    EXPECT_GT(t, 0.0);
    EXPECT_TRUE(kBox.contains(p + (t - 1e-9) * k));
    EXPECT_FALSE(kBox.contains(p + (t + 1e-9) * k));
  }
}

TEST(Box, ExitSideFromOutside) {
  EXPECT_EQ(kBox.exit_side({2.0, 3.0, 0.0}, {0.0, 0.0, 1.0}), Side::kTop);      // through the box
  EXPECT_EQ(kBox.exit_side({2.0, 3.0, 0.0}, {0.0, 0.0, -1.0}), Side::kBottom);  // away from it
  EXPECT_EQ(kBox.exit_side({2.0, 3.0, 9.0}, core::Vec3(1, 0, 0.1).normalized()), Side::kTop);
  EXPECT_EQ(kBox.exit_side({0.0, 3.0, 4.0}, {0.0, 1.0, 0.0}), Side::kLeft);  // past it
  EXPECT_EQ(kBox.exit_side({2.0, 3.0, 8.0}, {0.0, 0.0, 1.0}), Side::kTop);   // from its border
}

}  // namespace
}  // namespace evenglow::tracer
