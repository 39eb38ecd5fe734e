#include "design/tolerance/figures.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

TEST(Figures, StandInTheOrderOfTheirNames) {
  FinalJudgment judged;
  judged.rms_corrected = {0.02, 0.001};
  judged.uniformity_9 = 0.8;
  judged.uniformity_9_se = 0.01;
  judged.uniformity_13 = 0.7;
  judged.uniformity_13_se = 0.02;
  judged.luminance_mean = {2500, 3};
  judged.luminance_center = 2600;
  judged.luminance_center_se = 9;
  judged.efficiency = {0.6, 0.001};
  const auto figures = figures_of(judged);
  ASSERT_EQ(figures.size(), kFigures.size());
  const auto value = [&](const char* name) { return figures[static_cast<std::size_t>(figure_index(name))]; };
  EXPECT_EQ(value("rms_corrected").value, 0.02);
  EXPECT_EQ(value("uniformity_9").se, 0.01);
  EXPECT_EQ(value("uniformity_13").value, 0.7);
  EXPECT_EQ(value("luminance_mean_cd_m2").se, 3.0);
  EXPECT_EQ(value("luminance_centre_cd_m2").value, 2600.0);
  EXPECT_EQ(value("efficiency").value, 0.6);
  EXPECT_EQ(figure_index("rms"), -1);
}

}  // namespace
}  // namespace evenglow::design
