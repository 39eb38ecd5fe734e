#include "tracer/polarized_bsdf/held_totals.h"

#include <gtest/gtest.h>

#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

constexpr double kRad = core::kRadPerDeg;

TEST(HeldTotals, BeginBeyondTheLastIncidence) {
  const HeldTotals held(60.0 * kRad);
  EXPECT_FALSE(held.is_beyond(60.0 * kRad));
  EXPECT_TRUE(held.is_beyond(60.1 * kRad));
}

TEST(HeldTotals, AreMadeOncePerPsi) {
  HeldTotals held(0.0);
  int calls = 0;
  const auto totals = [&] {
    ++calls;
    return std::array<double, 2>{0.25 * calls, 0.5};
  };
  EXPECT_EQ(held.at(0.0, totals)[0], 0.25);
  EXPECT_EQ(held.at(1.0, totals)[0], 0.5);
  EXPECT_EQ(held.at(0.0, totals)[0], 0.25);
  EXPECT_EQ(calls, 2);
}

TEST(HeldTotals, TellWhereTheDataEnd) {
  EXPECT_EQ(HeldTotals(60.0 * kRad).remark("a.csv", false),
            "a.csv: no data beyond sigma = 60 degrees; the lobes of that incidence are held, and its totals");
  EXPECT_EQ(HeldTotals(60.0 * kRad).remark("a.csv", true),
            "a.csv: no data beyond sigma = 60 degrees; the lobes of that incidence are held");
  EXPECT_EQ(HeldTotals(80.0 * kRad).remark("a.csv", false), "");
}

}  // namespace
}  // namespace evenglow::tracer
