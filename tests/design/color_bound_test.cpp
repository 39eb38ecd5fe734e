#include "design/problem/color_bound.h"

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"
#include "core/light/color.h"

namespace evenglow::design {
namespace {

/// Half of the cells with `share` more blue light than the others; the same in each batch.
Observation display(double share) {
  const core::CellGrid grid = core::CellGrid::over(4, 2, 0, 0, 4, 2);
  Observation o;
  o.map = {{grid, 1.0}, {grid, 0.0}};
  o.luminance = o.color_x = o.color_z = core::Tally(8);
  for (int b = 0; b < 10; ++b) {
    std::vector<double> x, y, z;
    for (int i = 0; i < 8; ++i) {
      const core::Vec3 xyz = (i < 4 ? 1.0 + share : 1.0) * core::color_matching(460.0) + core::color_matching(570.0);
      x.push_back(xyz.x());
      y.push_back(xyz.y());
      z.push_back(xyz.z());
    }
    o.color_x.add_batch(std::move(x));
    o.luminance.add_batch(std::move(y));
    o.color_z.add_batch(std::move(z));
  }
  return o;
}

TEST(ColorBound, TakesTheRmsOfTheCells) {
  const auto color = color_rms(display(0.1));
  ASSERT_TRUE(color);
  const core::Vec3 blue = core::color_matching(460.0), yellow = core::color_matching(570.0);
  const core::Vec2 a = core::chromaticity_uv(1.1 * blue + yellow), b = core::chromaticity_uv(blue + yellow);
  EXPECT_NEAR(color->value, 0.5 * (a - b).norm(), 0.02 * (a - b).norm());
  EXPECT_NEAR(color_rms(display(0.0))->value, 0.0, 1e-6);
  EXPECT_FALSE(color_rms(Observation{}));
}

TEST(ColorBound, IsKeptWithinItsError) {
  EXPECT_TRUE(keeps_color(core::Estimate{0.0041, 0.0002}, 0.004));
  EXPECT_FALSE(keeps_color(core::Estimate{0.0043, 0.0002}, 0.004));
  EXPECT_TRUE(keeps_color(std::nullopt, 0.004));
  EXPECT_TRUE(keeps_color(core::Estimate{0.1, 0.0}, std::nullopt));
}

TEST(ColorBound, SaysWhatTheFinalTraceShows) {
  EXPECT_NE(color_verdict({0.003, 0.0001}, 0.004).find("the bound of 0.00400 is kept"), std::string::npos);
  EXPECT_NE(color_verdict({0.0041, 0.0001}, 0.004).find("within its error"), std::string::npos);
  EXPECT_NE(color_verdict({0.005, 0.0001}, 0.004).find("NOT kept"), std::string::npos);
}

}  // namespace
}  // namespace evenglow::design
