#include "design/dots/relaxation.h"

#include <gtest/gtest.h>

#include "design/dots/discrepancy.h"
#include "design/dots/dot_index.h"
#include "design/dots/placement.h"
#include "design/dots/power_spectrum.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

TEST(Relaxation, MakesBlueNoiseWithoutDirection) {
  const CoverageMap map(core::CellField(graded_coverage().grid, 0.1), whole_plate());
  DotSpec spec;
  spec.diameter = 0.03;
  const Placement placed = place_dots(spec, map, 2);
  const DotStore index = index_dots(placed.dots, {0, 20, 0, 10}, 2);
  const auto windows = sample_windows(index, whole_plate(), 600.0);
  const PowerSpectrum spectrum = power_spectrum(windows, 2);
  EXPECT_LT(spectrum.low_power, 0.05);
  EXPECT_NEAR(spectrum.peak_frequency, 1.0, 0.1);
  EXPECT_LT(spectrum.peak_power, 5.0);
  EXPECT_LT(spectrum.direction_contrast, 1.4);
  const DiscrepancyStatistics discrepancy = discrepancy_statistics(windows, 2);
  EXPECT_EQ(discrepancy.accepted, discrepancy.windows);
  EXPECT_LT(discrepancy.mean_ratio, 0.4);
}

TEST(Relaxation, CrowdsNoBorder) {
  const CoverageMap map(core::CellField(graded_coverage().grid, 0.1), whole_plate());
  DotSpec spec;
  spec.diameter = 0.03;
  const Placement placed = place_dots(spec, map, 2);
  // In a strip of six spacings along the edges there are as many dots as the coverage asks for, within 3 %.
  const double density = 0.1 / core::footprint_area(spec.footprint, spec.diameter), strip = 6.0 / std::sqrt(density);
  double count = 0.0;
  for (const core::Dot& dot : placed.dots)
    count += dot.x < strip || dot.y < strip || 20.0 - dot.x < strip || 10.0 - dot.y < strip;
  const double area = 200.0 - (20.0 - 2.0 * strip) * (10.0 - 2.0 * strip);
  EXPECT_NEAR(count / (density * area), 1.0, 0.03);
}

TEST(Separation, PushesCloseDotsApart) {
  const CoverageMap map(core::CellField(core::CellGrid::over(1, 1, 0.0, 0.0, 20.0, 10.0), 0.1), whole_plate());
  DotSpec spec;
  DotStore store(map.grid(), {3});
  for (std::size_t i = 0; i < 3; ++i) {
    store.dots().x[i] = 5.0 + 0.01 * static_cast<double>(i);
    store.dots().y[i] = 5.0;
    store.dots().diameter[i] = 0.06f;
  }
  store.sort(0);
  EXPECT_TRUE(separate(spec, map, 400, 1, store));
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      EXPECT_GE(std::hypot(store.dots().x[i] - store.dots().x[j], store.dots().y[i] - store.dots().y[j]), 0.07);
    }
  }
}

TEST(Separation, SettlesWhatCannotBePushedApart) {
  // 60 dots of 0.6 mm in 2 mm x 2 mm: no more than about 9 have room.
  const FreeArea free({0.0, 2.0, 0.0, 2.0}, {}, {}, {});
  const CoverageMap map(core::CellField(core::CellGrid::over(1, 1, 0.0, 0.0, 2.0, 2.0), 0.1), free);
  DotSpec spec;
  DotStore store(map.grid(), {60});
  const auto places = random_dots(60, 3);
  for (std::size_t i = 0; i < 60; ++i) {
    store.dots().x[i] = 0.3 + 0.07 * places[i].x;
    store.dots().y[i] = 0.3 + 0.14 * places[i].y;
    store.dots().diameter[i] = 0.6f;
  }
  store.sort(0);
  EXPECT_FALSE(separate(spec, map, 50, 1, store));
  const std::size_t removed = settle_conflicts(spec, map, store);
  EXPECT_EQ(store.size() + removed, 60u);
  EXPECT_GE(store.size(), 3u);
  for (std::size_t i = 0; i < store.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j)
      EXPECT_GE(std::hypot(store.dots().x[i] - store.dots().x[j], store.dots().y[i] - store.dots().y[j]), 0.61);
  }
}

}  // namespace
}  // namespace evenglow::tests
