#include "core/light/cie_1931.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(Cie1931, EqualEnergyIsWhite) {
  // The functions are scaled so that the equal-energy spectrum has X = Y = Z; the table's rounding leaves 1e-5. A wrong
  // digit in any entry above 0.001 would show.
  Vec3 sum = Vec3::Zero();
  for (double nm = 380.0; nm <= 780.0; nm += 5.0) sum += color_matching(nm);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], 21.3714, 2e-4);
}

TEST(Cie1931, LuminosityPeaksAt555) {
  EXPECT_EQ(color_matching(555.0).y(), 1.0);
  EXPECT_NEAR(color_matching(507.5).y(), 0.5 * (0.4073 + 0.503), 1e-12);
  EXPECT_EQ(color_matching(379.9), Vec3::Zero());
  EXPECT_EQ(color_matching(780.1), Vec3::Zero());
  EXPECT_EQ(color_matching(780.0).y(), 0.000015);
}

}  // namespace
}  // namespace evenglow::core
