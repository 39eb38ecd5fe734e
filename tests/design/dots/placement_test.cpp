#include "design/dots/placement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/dots/cell_errors.h"
#include "design/dots/dot_index.h"
#include "design/dots/neighbors.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;
using ::testing::HasSubstr;

class EachMode : public ::testing::TestWithParam<DotMode> {
 protected:
  EachMode() {
    spec.mode = GetParam();
    spec.diameter_max = 0.08;
  }
  DotSpec spec;
};

TEST_P(EachMode, HoldsEachCellWithinOneDot) {
  const CoverageMap map(graded_coverage(), whole_plate());
  const Placement placed = place_dots(spec, map, 2);
  const CellErrors errors = cell_errors(placed.dots, spec.footprint, map);
  EXPECT_LE(errors.worst_dots, 1.0 + 1e-6);
  EXPECT_EQ(errors.beyond_one, 0u);
  EXPECT_EQ(placed.removed, 0u);
  EXPECT_NEAR(placed.area, placed.wanted_area, 0.004 * placed.wanted_area);
  EXPECT_GT(placed.dots.size(), 1000u);
}

TEST_P(EachMode, KeepsGapSizesAndBorders) {
  const CoverageMap map(graded_coverage(), whole_plate());
  const Placement placed = place_dots(spec, map, 2);
  const auto n = neighbor_statistics(index_dots(placed.dots, {0, 20, 0, 10}, 1), spec.footprint, 1);
  EXPECT_GE(n.least_gap, spec.gap - 1e-8);
  for (const core::Dot& dot : placed.dots) {
    const double r = static_cast<double>(dot.radius);
    ASSERT_GE(dot.x - r, -1e-6);
    ASSERT_LE(dot.x + r, 20.0 + 1e-6);
    ASSERT_GE(dot.y - r, -1e-6);
    ASSERT_LE(dot.y + r, 10.0 + 1e-6);
    if (spec.mode == DotMode::spacing) {
      ASSERT_FLOAT_EQ(dot.radius, 0.03f);
    } else {
      ASSERT_GE(r, 0.5 * spec.diameter_min - 1e-8);
      ASSERT_LE(r, 0.5 * spec.diameter_max + 1e-8);
      const double steps = 2.0 * r / spec.size_step;
      ASSERT_NEAR(steps, std::round(steps), 1e-4);
    }
  }
}

TEST_P(EachMode, KeepsZonesAndMarginsFree) {
  const FreeArea free = whole_plate({{4.0, 7.3, 2.0, 5.0}}, {{14.0, 6.0, 2.2}}, {0.7, 0.0, 0.3, 0.2});
  const CoverageMap map(graded_coverage(), free);
  const Placement placed = place_dots(spec, map, 2);
  for (const core::Dot& dot : placed.dots)
    ASSERT_GE(free.clearance(dot.x, dot.y, 1.0), static_cast<double>(dot.radius) - 2e-6);
  const double zones = 3.3 * 3.0 + 3.14159265 * 2.2 * 2.2;
  EXPECT_LT(placed.wanted_area, 0.12 * (200.0 - zones));
  EXPECT_NEAR(placed.area, placed.wanted_area, (spec.mode == DotMode::lattice ? 0.05 : 0.02) * placed.wanted_area);
}

TEST_P(EachMode, SameSeedSameBitsOnAnyNumberOfThreads) {
  const CoverageMap map(graded_coverage(), whole_plate());
  const Placement one = place_dots(spec, map, 1), four = place_dots(spec, map, 4);
  EXPECT_EQ(one.dots, four.dots);
  if (spec.mode == DotMode::lattice) return;
  spec.seed = 2;
  EXPECT_NE(place_dots(spec, map, 4).dots, one.dots);
}

INSTANTIATE_TEST_SUITE_P(Placement, EachMode, ::testing::Values(DotMode::spacing, DotMode::lattice, DotMode::both));

std::string fault_of(const DotSpec& spec, const CoverageMap& map) {
  try {
    place_dots(spec, map, 1);
  } catch (const core::ConfigError& error) {
    return error.faults()[0].to_string();
  }
  return "none";
}

TEST(Placement, RefusesWhatTheLimitsCannotHold) {
  core::CellField field = graded_coverage();
  field.values[3] = 0.8;
  const CoverageMap map(field, whole_plate());
  DotSpec spec;
  EXPECT_THAT(fault_of(spec, map), HasSubstr("cell (3, 0) asks for 0.8"));
  spec.accept_shortfall = true;
  const Placement placed = place_dots(spec, map, 1);
  EXPECT_EQ(placed.short_cells, 1u);
  EXPECT_LT(placed.area, placed.wanted_area);
}

TEST(Placement, RefusesLatticesWithoutRoomAndTooManyDots) {
  const CoverageMap map(graded_coverage(), whole_plate());
  DotSpec spec;
  spec.mode = DotMode::lattice;
  spec.pitch = 0.035;
  EXPECT_THAT(fault_of(spec, map), HasSubstr("pitch_um: must leave room"));
  spec.mode = DotMode::spacing;
  spec.diameter = 0.0005;
  EXPECT_THAT(fault_of(spec, map), HasSubstr("must not make more than 50 million dots"));
  EXPECT_THAT(fault_of(DotSpec{}, CoverageMap(core::CellField(map.grid(), 0.0), whole_plate())),
              HasSubstr("at least one dot"));
}

TEST(Placement, SquareDotsDoNotOverlapAtTheirCorners) {
  const CoverageMap map(graded_coverage(), whole_plate());
  DotSpec spec;
  spec.footprint = core::Footprint::square;
  const Placement placed = place_dots(spec, map, 2);
  const auto n = neighbor_statistics(index_dots(placed.dots, {0, 20, 0, 10}, 1), spec.footprint, 1);
  EXPECT_GE(n.least_gap, spec.gap - 1e-8);
  EXPECT_NEAR(static_cast<double>(placed.dots.size()) * 0.06 * 0.06, placed.wanted_area, 0.004 * placed.wanted_area);
}

/// An unwanted placement must not keep its user waiting: this one takes minutes when it is let go on.
TEST(Placement, LeavesOffWhenAStopIsAskedFor) {
  DotSpec spec;
  spec.mode = DotMode::spacing;
  spec.diameter = 0.008;
  spec.gap = 0.001;
  const core::CellGrid cells = core::CellGrid::over(20, 20, 0.0, 0.0, 12.0, 12.0);
  const FreeArea free({0.0, 12.0, 0.0, 12.0}, {}, {}, {});
  const CoverageMap map(core::CellField(cells, 0.5), free);
  std::stop_source stop;
  stop.request_stop();
  const core::DotPattern scattered = place_dots(spec, map, 2, stop.get_token()).dots;
  EXPECT_GT(scattered.size(), 1000000U);  // as they were thrown: nothing has moved them
  EXPECT_EQ(place_dots(spec, map, 1, stop.get_token()).dots, scattered);
}

}  // namespace
}  // namespace evenglow::tests
