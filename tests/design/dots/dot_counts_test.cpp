#include "design/dots/dot_counts.h"

#include <cmath>
#include <cstdlib>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

core::CellField constant(int nx, int ny, double value) {
  return core::CellField(core::CellGrid{nx, ny, 0.0, 0.0, 1.0, 1.0}, value);
}

TEST(DotCounts, WholeNumbersStayAsTheyAre) {
  for (const int count : whole_counts(constant(7, 5, 3.0))) EXPECT_EQ(count, 3);
  for (const int count : whole_counts(constant(7, 5, 0.0))) EXPECT_EQ(count, 0);
}

TEST(DotCounts, EachIsRoundedDownOrUp) {
  core::CellField wanted = constant(40, 30, 0.0);
  for (std::size_t i = 0; i < wanted.values.size(); ++i)
    wanted.values[i] = std::fmod(0.37 * static_cast<double>(i), 9.0);
  const auto counts = whole_counts(wanted);
  ASSERT_EQ(counts.size(), wanted.values.size());
  for (std::size_t i = 0; i < counts.size(); ++i) {
    EXPECT_GE(counts[i], std::floor(wanted.values[i])) << i;
    EXPECT_LE(counts[i], std::ceil(wanted.values[i])) << i;
  }
}

// A constant of a fifth: every block of 10 x 10 cells must hold close to 20 dots, and the whole close to its sum.
TEST(DotCounts, SumsOverNeighborhoodsStayClose) {
  constexpr int kSide = 60;
  const auto counts = whole_counts(constant(kSide, kSide, 0.2));
  int all = 0;
  for (int by = 0; by < kSide; by += 10) {
    for (int bx = 0; bx < kSide; bx += 10) {
      int block = 0;
      for (int y = by; y < by + 10; ++y) {
        for (int x = bx; x < bx + 10; ++x) block += counts[static_cast<std::size_t>(y * kSide + x)];
      }
      EXPECT_LE(std::abs(block - 20), 4) << bx << ", " << by;
      all += block;
    }
  }
  EXPECT_LE(std::abs(all - 720), kSide / 2)
      << "what rounding leaves over: at most half a dot for each cell of the last row";
}

}  // namespace
}  // namespace evenglow::design
