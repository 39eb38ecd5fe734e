#include "design/dots/sample_windows.h"

#include <gtest/gtest.h>

#include "design/dots/dot_index.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

constexpr RectangleZone kPlate{0.0, 20.0, 0.0, 10.0};

TEST(SampleWindows, ACutHoldsTheDotsInItsOwnUnits) {
  const DotStore store = index_dots(lattice_pattern(0.5), kPlate, 1);
  const SampleWindow window = cut_window(store, 2.0, 3.0, 4.0);
  EXPECT_EQ(window.x.size(), 64u);
  for (std::size_t i = 0; i < window.x.size(); ++i) {
    const double column = window.x[i] * 8.0 - 0.5, row = window.y[i] * 8.0 - 0.5;
    ASSERT_NEAR(column, std::round(column), 1e-9);
    ASSERT_NEAR(row, std::round(row), 1e-9);
    ASSERT_NEAR(window.area[i], core::footprint_area(core::Footprint::round, 0.06), 1e-9);
  }
  EXPECT_NEAR(window.slope_x, 0.0, 1e-9);
}

/// Dots with odds 1 + s (x - 1/2): E[12 (mean x - 1/2)] = s. 5 sigma of 40,000 dots: 12 x 5 x 0.29 / 200 = 0.087.
TEST(SampleWindows, TheSlopeIsThatOfTheDensity) {
  core::PhotonRng rng({4, 0, 0}, 0);
  core::DotPattern dots;
  while (dots.size() < 40'000) {
    const double x = rng.uniform();
    if (rng.uniform() < (1.0 + 0.8 * (x - 0.5)) / 1.4) dots.push_back({10.0 * x, 10.0 * rng.uniform(), 0.01f, 0.0f});
  }
  const SampleWindow window = cut_window(index_dots(dots, kPlate, 1), 0.0, 0.0, 10.0);
  EXPECT_NEAR(window.slope_x, 0.8, 0.087);
  EXPECT_NEAR(window.slope_y, 0.0, 0.087);
}

TEST(SampleWindows, HoldAboutAsManyDotsAsWanted) {
  const auto windows = sample_windows(index_dots(lattice_pattern(0.07), kPlate, 1), whole_plate(), 400.0);
  EXPECT_EQ(windows.size(), 64u);
  for (const SampleWindow& window : windows) {
    EXPECT_GT(window.x.size(), 300u);
    EXPECT_LT(window.x.size(), 520u);
  }
}

TEST(SampleWindows, LieInTheFreeArea) {
  const FreeArea half = whole_plate({{0.0, 10.0, 0.0, 10.0}});
  const auto windows = sample_windows(index_dots(lattice_pattern(0.07), kPlate, 1), half, 400.0);
  EXPECT_EQ(windows.size(), 32u);
  for (const SampleWindow& window : windows) EXPECT_GE(window.x0, 10.0 - 1e-9);
}

TEST(SampleWindows, LeaveSteepPlacesOut) {
  core::DotPattern dots = random_dots(40'000, 2);
  for (core::Dot& dot : dots) dot.x *= dot.x / 20.0;  // density falls like 1 / sqrt(x): steep at the left alone
  const auto windows = sample_windows(index_dots(dots, kPlate, 1), whole_plate(), 2000.0);
  EXPECT_LT(windows.size(), 64u);
  EXPECT_GT(windows.size(), 20u);
}

}  // namespace
}  // namespace evenglow::tests
