#include "design/dots/dot_moves.h"

#include <gtest/gtest.h>

#include "tests/design/dots/dot_samples.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;

class Moves : public ::testing::Test {
 protected:
  const CoverageMap map{graded_coverage(), whole_plate({{4.0, 6.0, 4.0, 6.0}})};
  const DotSpec spec;
  double x = 3.0, y = 5.0;
};

TEST_F(Moves, AFreeDotGoesTheWholeWay) {
  move_free(spec, map, 0.5, -0.25, 0.06f, x, y);
  EXPECT_DOUBLE_EQ(x, 3.5);
  EXPECT_DOUBLE_EQ(y, 4.75);
}

TEST_F(Moves, ADotSlidesAlongABorder) {
  move_free(spec, map, 1.5, 0.5, 0.06f, x, y);  // x would end in the zone
  EXPECT_DOUBLE_EQ(x, 3.0);
  EXPECT_DOUBLE_EQ(y, 5.5);
}

TEST_F(Moves, ADotInACornerStays) {
  x = 0.04;
  y = 0.04;
  move_free(spec, map, -0.02, -0.02, 0.06f, x, y);
  EXPECT_DOUBLE_EQ(x, 0.04);
  EXPECT_DOUBLE_EQ(y, 0.04);
}

/// Cells of 1.25 mm: the dot of the third one goes half of its way to the border at 3.75.
TEST_F(Moves, ADotThatMustStayInItsCellGoesHalfOfTheWayToItsBorder) {
  move_within(spec, map, 4 * 16 + 2, 0.9, 0.0, 0.06f, x, y);
  EXPECT_DOUBLE_EQ(x, 0.5 * (3.0 + 3.75));
  move_within(spec, map, 4 * 16 + 2, 0.1, 0.0, 0.06f, x, y);
  EXPECT_DOUBLE_EQ(x, 0.5 * (3.0 + 3.75) + 0.1);
}

}  // namespace
}  // namespace evenglow::tests
