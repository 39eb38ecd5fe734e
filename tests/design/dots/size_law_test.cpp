#include "design/dots/size_law.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

TEST(SizeLaw, OneSizeInModeSpacing) {
  const CoverageMap map(graded_coverage(), whole_plate());
  const SizeLaw law({}, map);
  EXPECT_DOUBLE_EQ(law.diameter(0.03), 0.06);
  EXPECT_DOUBLE_EQ(law.diameter(0.25), 0.06);
  const double area = core::footprint_area(core::Footprint::round, 0.06);
  EXPECT_DOUBLE_EQ(law.area(0.1), area);
  EXPECT_DOUBLE_EQ(law.spacing(0.1), std::sqrt(area / 0.1));
  EXPECT_DOUBLE_EQ(law.widest(), 2.5);
  EXPECT_DOUBLE_EQ(law.spacing(0.0), 2.5);
}

/// From the least to the greatest cell, a straight line of the logarithms within 3 % of the limits.
TEST(SizeLaw, GrowsWithTheCoverageInModeBoth) {
  const CoverageMap map(graded_coverage(), whole_plate());
  DotSpec spec;
  spec.mode = DotMode::both;
  const SizeLaw law(spec, map);
  EXPECT_NEAR(law.diameter(0.03), 1.03 * spec.diameter_min, 1e-12);
  EXPECT_NEAR(law.diameter(0.25), spec.diameter_max / 1.03, 1e-12);
  const double middle = std::sqrt(0.03 * 0.25);
  EXPECT_NEAR(law.diameter(middle), std::sqrt(spec.diameter_min * spec.diameter_max), 1e-12);
  EXPECT_NEAR(law.diameter(0.01), 1.03 * spec.diameter_min, 1e-12);
  EXPECT_NEAR(law.diameter(0.9), spec.diameter_max / 1.03, 1e-12);
}

TEST(SizeLaw, LimitsWithoutRoomAreTheSize) {
  const CoverageMap map(graded_coverage(), whole_plate());
  DotSpec spec;
  spec.mode = DotMode::both;
  spec.diameter_min = spec.diameter_max = 0.05;
  EXPECT_DOUBLE_EQ(SizeLaw(spec, map).diameter(0.1), 0.05);
}

}  // namespace
}  // namespace evenglow::tests
