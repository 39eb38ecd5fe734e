#include "design/report/color_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace evenglow::design {
namespace {

/// L* of CIELAB of an sRGB color, from its definition (IEC 61966-2-1, ISO/CIE 11664-4).
double lightness(const Rgb& c) {
  const auto linear = [](double v) { return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4); };
  const double y = 0.2126729 * linear(c.red) + 0.7151522 * linear(c.green) + 0.0721750 * linear(c.blue);
  return y > 216.0 / 24389.0 ? 116.0 * std::cbrt(y) - 16.0 : 24389.0 / 27.0 * y;
}

double step(const Rgb& a, const Rgb& b) {
  return std::max({std::abs(a.red - b.red), std::abs(a.green - b.green), std::abs(a.blue - b.blue)});
}

TEST(ColorMap, LightnessRisesInEqualSteps) {
  for (const ColorMap* map : {&ColorMap::luminance(), &ColorMap::density()}) {
    const double low = lightness(map->at(0.0));
    const double high = lightness(map->at(1.0));
    EXPECT_GT(high - low, 70.0);
    for (int i = 0; i <= 255; ++i) EXPECT_NEAR(lightness(map->at(i / 255.0)), low + (high - low) * i / 255.0, 0.6) << i;
  }
}

TEST(ColorMap, DifferenceIsBrightestWithoutOneAndEvenToBothSides) {
  const ColorMap& map = ColorMap::difference();
  for (int i = 0; i <= 127; ++i) {
    const double below = lightness(map.at(i / 255.0));
    EXPECT_NEAR(below, lightness(map.at(1.0 - i / 255.0)), 0.6) << i;
    EXPECT_LT(below, lightness(map.at((i + 1) / 255.0)) + (i == 127 ? 0.1 : 0.0)) << i;
  }
  EXPECT_GT(map.at(0.0).blue, map.at(0.0).red + 0.2);
  EXPECT_GT(map.at(1.0).red, map.at(1.0).blue + 0.2);
}

TEST(ColorMap, NoScaleJumps) {
  for (const ColorMap* map : {&ColorMap::luminance(), &ColorMap::density(), &ColorMap::difference()}) {
    for (int i = 0; i < 255; ++i) EXPECT_LT(step(map->at(i / 255.0), map->at((i + 1) / 255.0)), 0.014) << i;
  }
}

TEST(ColorMap, RainbowRunsFromBlueOverGreenToRed) {
  const ColorMap& map = ColorMap::rainbow();
  EXPECT_EQ(map.at(0.0).hex(), "000080");
  EXPECT_EQ(map.at(1.0).hex(), "800000");
  EXPECT_NEAR(map.at(0.5).green, 1.0, 1e-9);
  EXPECT_EQ(map.hex().size(), 6U * 256U);
}

TEST(ColorMap, NoValueIsGray) {
  EXPECT_EQ(ColorMap::difference().at(std::numeric_limits<double>::quiet_NaN()).hex(), ColorMap::no_data().hex());
}

}  // namespace
}  // namespace evenglow::design
