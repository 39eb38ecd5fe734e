#include "app/tolerance_plots.h"

#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace evenglow::app {
namespace {

TEST(TolerancePlots, HistogramHoldsEverySampleAndTheLimits) {
  design::ToleranceSpec spec;
  spec.limits = {{"uniformity_9", 0.8, 0.99}};
  design::ToleranceSamples run;
  run.reference.assign(design::kFigures.size(), {0.9, 0.01});
  for (int i = 0; i < 50; ++i)
    run.samples.push_back(
        {{1.0 * i}, std::vector<core::Estimate>(design::kFigures.size(), {0.7 + 0.005 * i, 0.02}), {}});
  const auto plot = figure_histogram(1, spec, run, summarize(spec, run));
  ASSERT_EQ(plot.curves.size(), 5U);  // as traced, without noise, nominal, two limits
  for (std::size_t c = 0; c < 2; ++c) {
    const auto& y = plot.curves[c].y;
    EXPECT_NEAR(std::accumulate(y.begin(), y.end(), 0.0), 100.0, 1e-9);
    EXPECT_EQ(y.front(), 0.0);
    EXPECT_EQ(y.back(), 0.0);
  }
  EXPECT_THAT(plot.curves[2].x, testing::Each(90.0));
  EXPECT_THAT(plot.curves[3].x, testing::Each(80.0));
  EXPECT_THAT(plot.curves[4].x, testing::Each(99.0));
}

TEST(TolerancePlots, FiguresWithLimitsComeFirst) {
  design::ToleranceSpec spec;
  spec.limits = {{"efficiency", 0.5, {}}};
  EXPECT_THAT(figure_order(spec), testing::ElementsAre(5, 0, 1, 2, 3, 4));
}

}  // namespace
}  // namespace evenglow::app
