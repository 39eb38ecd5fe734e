#include "design/updaters/box_blur.h"

#include <cmath>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(101, 41, 0, 0, 101, 41);

core::CellField spike(int ix, int iy) {
  core::CellField field(kGrid, 0.0);
  field.values[static_cast<std::size_t>(iy * kGrid.nx + ix)] = 1.0;
  return field;
}

TEST(BoxBlur, HasTheWidthThatIsAskedForAlongEachAxis) {
  const core::CellField blurred = blur(spike(50, 20), 4.0, 2.0);
  double sum = 0.0, x2 = 0.0, y2 = 0.0, x1 = 0.0;
  for (int iy = 0; iy < kGrid.ny; ++iy) {
    for (int ix = 0; ix < kGrid.nx; ++ix) {
      const double value = blurred.values[static_cast<std::size_t>(iy * kGrid.nx + ix)];
      sum += value;
      x1 += value * (ix - 50);
      x2 += value * (ix - 50) * (ix - 50);
      y2 += value * (iy - 20) * (iy - 20);
    }
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
  EXPECT_NEAR(x1, 0.0, 1e-12);
  // A running mean of 2 r + 1 cells, three times, has the variance r (r + 1), r a whole number.
  EXPECT_NEAR(std::sqrt(x2), 4.0, 0.6);
  EXPECT_NEAR(std::sqrt(y2), 2.0, 0.6);
}

TEST(BoxBlur, KeepsWhatIsEvenAndTheSumNextToTheRim) {
  const core::CellField even = blur(core::CellField(kGrid, 3.0), 5.0, 5.0);
  for (const double value : even.values) EXPECT_NEAR(value, 3.0, 1e-12);
  const core::CellField corner = blur(spike(0, 0), 3.0, 3.0);
  double sum = 0.0;
  for (const double value : corner.values) sum += value;
  EXPECT_NEAR(sum, 1.0, 1e-12) << "the rim reflects";
  EXPECT_GT(corner.values[0], corner.values[1]);
}

TEST(BoxBlur, OfNoWidthChangesNothing) {
  EXPECT_EQ(blur(spike(3, 4), 0.1, 0.0).values, spike(3, 4).values);
}

}  // namespace
}  // namespace evenglow::design
