#include "core/light/color.h"

#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

TEST(Color, EqualEnergyIsTheWhitePoint) {
  const Vec2 xy = chromaticity_xy({1.0, 1.0, 1.0});
  EXPECT_NEAR(xy.x(), 1.0 / 3.0, 1e-15);
  EXPECT_NEAR(xy.y(), 1.0 / 3.0, 1e-15);
  const Vec2 uv = chromaticity_uv({1.0, 1.0, 1.0});
  EXPECT_NEAR(uv.x(), 4.0 / 19.0, 1e-15);
  EXPECT_NEAR(uv.y(), 9.0 / 19.0, 1e-15);
}

TEST(Color, IlluminantA) {
  // A black body of 2856 K (with c2 = 1.4388e-2 m K, 2855.5 K in today's scale) has x = 0.4476, y = 0.4074.
  const Vec2 xy = chromaticity_xy(black_body(2856.0));
  EXPECT_NEAR(xy.x(), 0.4476, 2e-4);
  EXPECT_NEAR(xy.y(), 0.4074, 2e-4);
}

TEST(Color, ABlackBodyHasItsOwnTemperature) {
  for (const double kelvin : {1500.0, 2856.0, 4000.0, 6500.0, 12000.0}) {
    const ColorTemperature found = color_temperature(black_body(kelvin));
    EXPECT_NEAR(found.kelvin, kelvin, 1e-4 * kelvin);
    EXPECT_NEAR(found.distance, 0.0, 1e-6);
  }
}

TEST(Color, IlluminantD65) {
  // x = 0.3127, y = 0.3290: 6504 K, Duv = +0.0032 (CIE 015:2018).
  const double x = 0.3127, y = 0.3290;
  const ColorTemperature found = color_temperature({x / y, 1.0, (1.0 - x - y) / y});
  EXPECT_NEAR(found.kelvin, 6504.0, 6.0);
  EXPECT_NEAR(found.distance, 0.0032, 1e-4);
}

TEST(Color, NoLightHasNoColor) {
  EXPECT_EQ(chromaticity_xy(Vec3::Zero()), Vec2::Zero());
  EXPECT_EQ(color_temperature(Vec3::Zero()).kelvin, 0.0);
}

}  // namespace
}  // namespace evenglow::core
