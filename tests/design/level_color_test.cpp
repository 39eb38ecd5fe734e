#include "design/engine/level_color.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

const std::vector<double> kLevels = {0.05, 0.1, 0.2, 0.4};
// The color is the less even the lower the level: longer ways in the plate.
const std::vector<core::Estimate> kColors = {{0.008, 1e-4}, {0.006, 1e-4}, {0.004, 1e-4}, {0.003, 1e-4}};

TEST(LevelColor, LeavesALevelThatKeepsTheBound) {
  const ColorLevel level = level_for_color({kLevels, kColors, 0.005, 0.0}, 0.2);
  EXPECT_EQ(level.level, 0.2);
  EXPECT_TRUE(level.kept);
  EXPECT_NE(level.note.find("the bound of 0.00500 is kept"), std::string::npos);
  // Between levels: half way in ln level from 0.006 to 0.004.
  EXPECT_EQ(level_for_color({kLevels, kColors, 0.00495, 0.0}, 0.1414214).level, 0.1414214);
  EXPECT_EQ(level_for_color({kLevels, kColors, 0.00485, 0.0}, 0.1414214).level, 0.2) << "its error counts";
}

TEST(LevelColor, GoesToTheNearestThatKeepsIt) {
  const ColorLevel level = level_for_color({kLevels, kColors, 0.0045, 0.0}, 0.07);
  EXPECT_EQ(level.level, 0.2);
  EXPECT_TRUE(level.kept);
  EXPECT_NE(level.note.find("0.2000 is taken, the nearest that keeps it"), std::string::npos) << level.note;
  const std::vector<core::Estimate> falling = {{0.002, 1e-4}, {0.003, 1e-4}, {0.006, 1e-4}, {0.009, 1e-4}};
  EXPECT_EQ(level_for_color({kLevels, falling, 0.0045, 0.0}, 0.4).level, 0.1) << "to either side";
  EXPECT_EQ(level_for_color({kLevels, falling, 0.0045, 0.3}, 0.4).level, 0.4) << "but not below the least level";
}

TEST(LevelColor, SaysWhereNoneKeepsIt) {
  const ColorLevel level = level_for_color({kLevels, kColors, 0.001, 0.0}, 0.1);
  EXPECT_FALSE(level.kept);
  EXPECT_EQ(level.level, 0.4);
  EXPECT_NE(level.note.find("no level keeps the bound of 0.00100"), std::string::npos) << level.note;
}

}  // namespace
}  // namespace evenglow::design
