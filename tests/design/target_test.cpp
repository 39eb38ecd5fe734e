#include "design/problem/target.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/problem/merit.h"

namespace evenglow::design {
namespace {

const core::CellGrid kDisplay = core::CellGrid::over(40, 20, 5, 5, 45, 25);

TEST(Target, CenterWeightedHasTheWantedCorners) {
  const core::CellField shape = target_shape({"center_weighted", 0.8, {}}, core::CellGrid::over(401, 401, 0, 0, 1, 1));
  EXPECT_NEAR(shape.values.front() / shape.values[200 * 401 + 200], 0.8, 0.002);
  EXPECT_NEAR(shape.values.back() / shape.values[200 * 401 + 200], 0.8, 0.002);
  EXPECT_NEAR(shape.values[200 * 401] / shape.values[200 * 401 + 200], 0.9, 0.002) << "middle of a side";
}

TEST(Target, JudgesLuminanceOverTarget) {
  DesignSpec spec;
  spec.target = {"center_weighted", 0.5, {}};
  const Target target(spec, kDisplay);
  EXPECT_FALSE(target.plain());
  EXPECT_NEAR(target.relative().mean(), 1.0, 1e-12);
  core::Tally luminance(kDisplay.size());
  for (int b = 0; b < 4; ++b) luminance.add_batch(target_shape(spec.target, kDisplay).values);
  EXPECT_GT(evenness(luminance).rms, 0.05);
  EXPECT_LT(evenness(target.judged(luminance)).rms, 1e-12);
}

TEST(Target, BlackCellsOfAMapDoNotCount) {
  DesignSpec spec;
  spec.target = {"map", 0.8, {2, 2, {1.0, 2.0, 0.0, 3.0}}};
  const Target target(spec, core::CellGrid::over(2, 2, 0, 0, 1, 1));
  EXPECT_EQ(target.counted(), 3U);
  EXPECT_EQ(target.relative().values, (std::vector<double>{0.5, 1.0, 0.0, 1.5}));
}

TEST(Target, FlattenedMasksFollowTheNearestCellThatCounts) {
  DesignSpec spec;
  spec.mask = {4, 1, {1, 1, 0, 0}};
  const core::CellGrid display = core::CellGrid::over(4, 1, 0, 0, 4, 1);
  const Target target(spec, display);
  EXPECT_EQ(target.share_counted(), 0.5);
  Observation observation;
  observation.map = {{display, 0.0}, {display, 0.0}};
  observation.map.luminance.values = {1, 2, 30, 40};
  observation.luminance = core::Tally(4);
  observation.luminance.add_batch({1, 2, 30, 40});
  target.flatten(observation);
  EXPECT_EQ(observation.map.luminance.values, (std::vector<double>{1, 2, 2, 2}));
  EXPECT_EQ(observation.luminance.batch(0), (std::vector<double>{1, 2, 2, 2}));
}

TEST(Target, OfNoCellIsRefused) {
  DesignSpec spec;
  spec.mask = {1, 1, {0.0}};
  EXPECT_THROW(Target(spec, kDisplay), core::Error);
}

TEST(Target, UniformIsPlain) {
  EXPECT_TRUE(Target(DesignSpec{}, kDisplay).plain());
}

}  // namespace
}  // namespace evenglow::design
