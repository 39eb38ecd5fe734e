#include "design/dots/exact_sizes.h"

#include <cmath>

#include <gtest/gtest.h>

#include "design/dots/start_dots.h"
#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

class ExactSizes : public ::testing::Test {
 protected:
  ExactSizes() { spec.mode = DotMode::both; }

  double held(const DotStore& store, std::size_t cell) const {
    double area = 0.0;
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i)
      area += core::footprint_area(spec.footprint, static_cast<double>(store.dots().diameter[i]));
    return area;
  }

  DotSpec spec;
  const CoverageMap map{graded_coverage(), whole_plate()};
};

TEST_F(ExactSizes, WholeStepsWithinTheLimitsThatHoldTheArea) {
  DotStore store = start_dots(spec, map, SizeLaw(spec, map), 1);
  fit_sizes(spec, map, spec.diameter_min, spec.diameter_max, true, 2, store);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) {
    const double dot = held(store, cell) / static_cast<double>(store.end(cell) - store.begin(cell));
    ASSERT_NEAR(held(store, cell), map.wanted(cell), dot) << cell;
  }
  for (const float diameter : store.dots().diameter) {
    const double steps = static_cast<double>(diameter) / spec.size_step;
    ASSERT_NEAR(steps, std::round(steps), 1e-3);
    ASSERT_GE(static_cast<double>(diameter), spec.diameter_min - 1e-8);
    ASSERT_LE(static_cast<double>(diameter), spec.diameter_max + 1e-8);
  }
}

/// To the wanted area or only into the tolerance of one dot: with a start 10 % too large both move, the first farther.
TEST_F(ExactSizes, FullGoesToTheAreaItself) {
  DotStore start = start_dots(spec, map, SizeLaw(spec, map), 1);
  for (float& diameter : start.dots().diameter) diameter *= 1.05f;
  DotStore full = start, near = start;
  fit_sizes(spec, map, spec.diameter_min, spec.diameter_max, true, 1, full);
  fit_sizes(spec, map, spec.diameter_min, spec.diameter_max, false, 1, near);
  double full_error = 0.0, near_error = 0.0;
  for (std::size_t cell = 0; cell < start.cell_count(); ++cell) {
    full_error += held(full, cell) - map.wanted(cell);
    near_error += held(near, cell) - map.wanted(cell);
  }
  EXPECT_LT(std::abs(full_error), 0.2 * near_error);
}

TEST_F(ExactSizes, NoDotGrowsOverABorder) {
  DotStore store = start_dots(spec, map, SizeLaw(spec, map), 1);
  for (float& diameter : store.dots().diameter) diameter *= 0.8f;
  fit_sizes(spec, map, spec.diameter_min, spec.diameter_max, true, 1, store);
  for (std::size_t i = 0; i < store.size(); ++i) {
    ASSERT_GE(map.free().clearance(store.dots().x[i], store.dots().y[i], 1.0),
              0.5 * static_cast<double>(store.dots().diameter[i]) - 1e-6);
  }
}

}  // namespace
}  // namespace evenglow::tests
