#include "design/report/axis.h"

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

std::vector<std::string> labels(const Axis& axis) {
  std::vector<std::string> texts;
  for (const Tick& tick : axis.ticks) texts.push_back(tick.label);
  return texts;
}

using Texts = std::vector<std::string>;

TEST(Axis, TicksAreRoundNumbersWithinTheRange) {
  EXPECT_EQ(labels(linear_axis({0.0, 140.0}, 5)), (Texts{"0", "50", "100"}));
  EXPECT_EQ(labels(rounded_axis({38.3, 41.2}, 5)), (Texts{"38", "39", "40", "41", "42"}));
  EXPECT_EQ(labels(rounded_axis({-0.3, 0.3}, 3)), (Texts{"-0.4", "-0.2", "0", "0.2", "0.4"}));
  EXPECT_EQ(labels(integer_axis(0, 0)), (Texts{"0"}));
  EXPECT_GE(linear_axis({1901.0, 2129.0}, 2).ticks.size(), 2U);
}

TEST(Axis, LogarithmicTicksAreOneTwoFive) {
  const Axis axis = log_axis({0.6, 42.0});
  EXPECT_EQ(labels(axis), (Texts{"0.5", "1", "2", "5", "10", "20", "50"}));
  EXPECT_NEAR(axis.position(5.0), 0.5, 1e-12);
  EXPECT_EQ(axis.position(-1.0), 0.0);
  EXPECT_EQ(labels(log_axis({1.0, 1.0})), (Texts{"1", "2"}));
  EXPECT_NEAR(log_axis({1e-30, 1.0}).range.low, 1e-5, 1e-12);
}

}  // namespace
}  // namespace evenglow::design
