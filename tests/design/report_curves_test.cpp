#include "design/report/report_curves.h"

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

TEST(ReportCurves, BorderOfTwoAzimuthBinsIsTheirMean) {
  const AngularLuminance four{{0, 90}, 4, {{1, 3}, {2, 3}, {4, 4}, {8, 4}}};
  EXPECT_EQ(luminance_towards(four, 0, 45.0).value, 1.0);
  EXPECT_EQ(luminance_towards(four, 0, 0.0).value, 4.5);  // the last bin and the first
  EXPECT_EQ(luminance_towards(four, 0, 0.0).se, 2.5);
  EXPECT_EQ(luminance_towards(four, 0, 180.0).value, 3.0);
  EXPECT_EQ(luminance_towards({{0, 90}, 1, {{7, 1}}}, 0, 90.0).value, 7.0);
}

TEST(ReportCurves, AngularSectionRunsFromSideToSide) {
  Report r = samples::report();
  const CurvePlot plot = angular_section({&r}, SectionDirection::along_y);
  ASSERT_EQ(plot.curves.size(), 1U);
  EXPECT_EQ(plot.curves[0].x, (std::vector<double>{-75, -45, -15, 15, 45, 75}));
  r.angular.reset();
  EXPECT_TRUE(angular_section({&r}, SectionDirection::along_y).curves.empty());
}

TEST(ReportCurves, RmsIsInPercentAndEndsWithTheFinalTrace) {
  const Report r = samples::report();
  const CurvePlot plot = rms_plot({&r});
  ASSERT_EQ(plot.curves.size(), 3U);
  EXPECT_NEAR(plot.curves[0].y[0], 30.0, 1e-12);
  EXPECT_NEAR(plot.curves[1].se[2], 0.1, 1e-12);
  EXPECT_EQ(plot.curves[2].x, (std::vector<double>{2}));
  EXPECT_NEAR(plot.curves[2].y[0], 10.0, 1e-12);
}

TEST(ReportCurves, NoiseOfTheStepsStandsBesideTheRmsOfOneRun) {
  Report r = samples::report();
  for (StepRecord& step : r.steps) step.noise = 0.05;
  const CurvePlot plot = rms_plot({&r});
  ASSERT_EQ(plot.curves.size(), 4U);
  EXPECT_EQ(plot.curves[3].name, "noise");
  EXPECT_NEAR(plot.curves[3].y[2], 5.0, 1e-12);
  EXPECT_EQ(rms_plot({&r, &r}).curves.size(), 6U);
}

}  // namespace
}  // namespace evenglow::design
