#include "design/report/histogram_plot.h"

#include <numeric>

#include <gtest/gtest.h>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

double sum(const Curve& curve) {
  return std::accumulate(curve.y.begin(), curve.y.end(), 0.0);
}

TEST(HistogramPlot, CountsEachCellOnceAboutAMeanOfOne) {
  const Report r = samples::report();
  const CurvePlot plot = luminance_histogram({&r});
  ASSERT_EQ(plot.curves.size(), 2U);
  for (const Curve& curve : plot.curves) {
    EXPECT_NEAR(sum(curve), 100.0, 1e-9);
    double mean = 0.0;
    for (std::size_t i = 0; i < curve.x.size(); ++i) mean += 0.01 * curve.x[i] * curve.y[i];
    EXPECT_NEAR(mean, 1.0, curve.x[1] - curve.x[0]);
    EXPECT_TRUE(curve.stepped);
  }
  EXPECT_EQ(plot.curves[0].name, "start");
}

TEST(HistogramPlot, FindsTheCellsOfEachValue) {
  Report r = samples::report();
  r.steps.resize(1);
  for (std::size_t i = 0; i < r.luminance.values.size(); ++i) r.luminance.values[i] = i % 4 == 0 ? 250.0 : 50.0;
  const CurvePlot plot = luminance_histogram({&r});  // mean 100
  ASSERT_EQ(plot.curves.size(), 1U);
  EXPECT_NEAR(plot.curves[0].y.front(), 75.0, 1e-9);
  EXPECT_NEAR(plot.curves[0].y.back(), 25.0, 1e-9);
  const double half = 0.5 * (plot.curves[0].x[1] - plot.curves[0].x[0]);
  EXPECT_NEAR(plot.curves[0].x.front() - half, 0.5, 1e-9);
  EXPECT_NEAR(plot.curves[0].x.back() + half, 2.5, 1e-9);
}

TEST(HistogramPlot, ShowsATargetAndLeavesOutWhatDoesNotCount) {
  Report r = samples::report();
  r.target = samples::ramp(6, 4, 1.0);
  r.target.values[0] = 0.0;
  const CurvePlot plot = luminance_histogram({&r});
  ASSERT_EQ(plot.curves.size(), 3U);
  EXPECT_EQ(plot.curves[1].name, "target");
  r.luminance.values[0] = 1e9;  // a cell that does not count
  EXPECT_EQ(luminance_histogram({&r}).curves[2].y, plot.curves[2].y);
}

TEST(HistogramPlot, OfSeveralHasTheirNamesAndOneSetOfBins) {
  const Report a = samples::report("a");
  Report b = samples::report("b");
  for (double& value : b.luminance.values) value = 7.0;
  const CurvePlot plot = luminance_histogram({&a, &b});
  ASSERT_EQ(plot.curves.size(), 2U);
  EXPECT_EQ(plot.curves[1].name, "b");
  EXPECT_EQ(plot.curves[0].x, plot.curves[1].x);
  EXPECT_TRUE(luminance_histogram({}).curves.empty());
  const Report none;
  EXPECT_TRUE(luminance_histogram({&none}).curves.empty());
}

}  // namespace
}  // namespace evenglow::design
