#include "design/report/number_format.h"

#include <limits>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

TEST(NumberFormat, ErrorSetsTheDecimals) {
  EXPECT_EQ(measured({3251.234, 12.345}), "3251 ± 12");
  EXPECT_EQ(measured({0.012345, 0.000456}, 100.0), "1.234 ± 0.046");
  EXPECT_EQ(measured({32513.0, 1234.0}), "32513 ± 1234");
  EXPECT_EQ(percent({0.5, 0.01}), "50.0 ± 1.0\u00a0%");
}

TEST(NumberFormat, WithoutAnErrorTheValueStandsAlone) {
  EXPECT_EQ(measured({0.25, 0.0}), "0.2500");
  EXPECT_EQ(measured({0.25, nan}), "0.2500");
  EXPECT_EQ(measured({nan, 1.0}), "\u2013");
}

TEST(NumberFormat, RoundsToSignificantDigits) {
  EXPECT_EQ(rounded(3284.49), "3284");
  EXPECT_EQ(rounded(0.0123456, 3), "0.0123");
  EXPECT_EQ(rounded(123456.7), "123457");
  EXPECT_EQ(rounded(0.0), "0");
  EXPECT_EQ(shortest(0.1), "0.1");
  EXPECT_EQ(grouped(1234567),
            "1\u00a0"
            "234\u00a0"
            "567");
}

}  // namespace
}  // namespace evenglow::design
