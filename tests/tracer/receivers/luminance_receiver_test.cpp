#include "tracer/receivers/luminance_receiver.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

const core::CellGrid kCells = core::CellGrid::over(4, 2, 1.0, 1.0, 9.0, 5.0);
constexpr double kCone = 10.0 * core::kRadPerDeg;

Crossing crossing(double x, double y, double polar_deg, Side side = Side::kTop, bool estimated = false) {
  const double t = polar_deg * core::kRadPerDeg;
  return {side, {x, y, 0.6}, {std::sin(t), 0.0, std::cos(t)}, estimated};
}

TEST(LuminanceReceiver, ScoresTheConeAndTheActiveArea) {
  const LuminanceReceiver receiver(kCells, kCone);
  EXPECT_EQ(receiver.bins(), 8U);
  const auto score = receiver.score(crossing(3.5, 3.5, 9.9));
  ASSERT_TRUE(score);
  EXPECT_EQ(score->bin, 5U);
  EXPECT_DOUBLE_EQ(score->weight, 1.0 / (core::kPi * std::pow(std::sin(kCone), 2)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 10.1)));
  EXPECT_FALSE(receiver.score(crossing(0.5, 3.5, 0.0)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 0.0, Side::kBottom)));
  EXPECT_FALSE(receiver.score(crossing(3.5, 3.5, 0.0, Side::kTop, true)));  // counted before
}

TEST(LuminanceReceiver, RefusesImpossibleCones) {
  EXPECT_THROW(LuminanceReceiver(kCells, 0.0), core::Error);
  EXPECT_THROW(LuminanceReceiver(kCells, 2.0), core::Error);
}

/// 100 lm over 200 photons, one photon with score w into a cell of 4 mm2: L = 0.5 w / 4 lm/(sr mm2), times 10^6.
TEST(LuminanceReceiver, Unit) {
  const LuminanceReceiver receiver(kCells, kCone);
  EXPECT_DOUBLE_EQ(luminance_per_score(receiver, 100.0, 200), 0.5 / 4.0 * 1e6);
  core::Tally tally(8);
  tally.add_batch({1, 0, 0, 0, 0, 0, 0, 3});
  tally.add_batch({3, 0, 0, 0, 0, 0, 0, 3});
  const LuminanceMap map = make_luminance_map(receiver, tally, 100.0, 200);
  EXPECT_DOUBLE_EQ(map.luminance.values[0], 4.0 * 125000.0);
  EXPECT_DOUBLE_EQ(map.standard_error.values[0], std::sqrt(2.0 * 2.0) * 125000.0);
  EXPECT_EQ(map.standard_error.values[7], 0.0);
}

}  // namespace
}  // namespace evenglow::tracer
