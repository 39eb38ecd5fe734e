#include "design/tolerance/yield.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// Values of the score interval by hand: p = 0.8, n = 10, z = 1.96: (0.8 + 0.1921 +- 0.3098) / 1.3841 ...
TEST(Yield, WilsonIntervalHasItsClosedForm) {
  const Share some = wilson(8, 10);
  EXPECT_EQ(some.value, 0.8);
  EXPECT_NEAR(some.low, 0.49016, 1e-5);
  EXPECT_NEAR(some.high, 0.94332, 1e-5);
  const Share none = wilson(0, 10), all = wilson(200, 200);
  EXPECT_EQ(none.low, 0.0);
  EXPECT_NEAR(none.high, 3.841459 / (10 + 3.841459), 1e-6);  // z^2 / (n + z^2)
  EXPECT_EQ(all.high, 1.0);
  EXPECT_NEAR(all.low, 200 / (200 + 3.841459), 1e-6);
}

TEST(Yield, BoundsAreKeptAtTheBoundItself) {
  const Limit both{"efficiency", 0.5, 0.7};
  EXPECT_TRUE(keeps(both, 0.5));
  EXPECT_TRUE(keeps(both, 0.7));
  EXPECT_FALSE(keeps(both, 0.499));
  EXPECT_FALSE(keeps(both, 0.701));
  EXPECT_FALSE(keeps(both, std::numeric_limits<double>::quiet_NaN()));
}

TEST(Yield, SamplesNearALimitBoundWhatNoiseMayDo) {
  // Sure, near above, near below, surely not; without noise the near ones have both passed.
  LimitedFigure one;
  one.limit.figure = "uniformity_9";
  one.limit.min = 0.8;
  one.seen = {{0.9, 0.01}, {0.81, 0.01}, {0.79, 0.01}, {0.7, 0.01}};
  one.corrected = {0.9, 0.81, 0.805, 0.7};
  const Yield y = yield_of({one});
  EXPECT_EQ(y.passed, 2);
  EXPECT_EQ(y.seen.value, 0.5);
  EXPECT_EQ(y.corrected.value, 0.75);
  EXPECT_EQ(y.near_limit, 2);
  EXPECT_EQ(y.least, 0.25);
  EXPECT_EQ(y.most, 0.75);
}

TEST(Yield, AllLimitsMustBeKept) {
  LimitedFigure a;
  a.limit.figure = "efficiency";
  a.limit.min = 0.5;
  a.seen = {{0.6, 0.001}, {0.6, 0.001}, {0.4, 0.001}};
  a.corrected = {0.6, 0.6, 0.4};
  LimitedFigure b;
  b.limit.figure = "rms_corrected";
  b.limit.max = 0.05;
  b.seen = {{0.01, 0.001}, {0.09, 0.001}, {0.0495, 0.001}};
  b.corrected = {0.01, 0.09, 0.0495};
  const Yield y = yield_of({a, b});
  EXPECT_EQ(y.passed, 1);
  EXPECT_EQ(y.near_limit, 0) << "what surely fails one limit is not near another";
  EXPECT_EQ(y.most, y.least);
}

/// Noise lowers a least over a greatest: what it takes is given back before the limit is looked at.
TEST(Yield, NearALimitIsJudgedWithoutTheShiftOfTheNoise) {
  LimitedFigure one;
  one.limit.figure = "uniformity_9";
  one.limit.min = 0.88;
  one.seen = {{0.87, 0.005}, {0.86, 0.005}, {0.80, 0.005}};
  one.corrected = {0.90, 0.89, 0.83};
  one.shift = -0.03;
  const Yield y = yield_of({one});
  EXPECT_EQ(y.passed, 0);
  EXPECT_NEAR(y.corrected.value, 2.0 / 3.0, 1e-12);
  EXPECT_GE(y.most, y.corrected.value);
  EXPECT_LE(y.least, y.corrected.value);
}

}  // namespace
}  // namespace evenglow::design
