#include "tracer/scene/backlight_spec.h"

#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10}, ";
const std::string kLeds = "sources: [{kind: led_row, count: 2}]";
const std::string kBeam = "sources: [{kind: beam}]";

/// The message of the faults that reading notes; empty if there are none.
std::string faults(const std::string& text) {
  try {
    backlight_of(text);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return {};
}

void expect_fault(const std::string& text, const std::string& part) {
  EXPECT_NE(faults(text).find(part), std::string::npos) << text << "\n" << faults(text);
}

TEST(BacklightSpec, Defaults) {
  const BacklightSpec spec = backlight_of("light_guide_plate: {}, " + kLeds);
  ASSERT_TRUE(spec.plate);
  EXPECT_EQ(spec.area.max, core::Vec3(140.0, 66.0, 0.6));
  EXPECT_NEAR(spec.plate->material(550.0).refractive_index, 1.4926, 1e-4);
  EXPECT_NEAR(spec.plate->material(550.0).absorption, 3e-5, 1e-12);
  EXPECT_FALSE(spec.microstructure);
  EXPECT_TRUE(spec.films.empty());
  EXPECT_FALSE(spec.reflectors[0]);
  ASSERT_TRUE(spec.angular);  // all three receivers
  EXPECT_EQ(spec.luminance.cells, core::CellGrid::over(96, 48, 0, 0, 140, 66));
  EXPECT_NEAR(spec.luminance.cone, 10.0 * core::kRadPerDeg, 1e-15);
  EXPECT_EQ(spec.luminance.estimator, LuminanceEstimator::kCounting);  // nothing scatters above
}

TEST(BacklightSpec, PlateOfAPlainConstantIsLossless) {
  const BacklightSpec spec = backlight_of("light_guide_plate: {refractive_index: 1.4938}, " + kLeds);
  EXPECT_EQ(spec.plate->material(550.0).refractive_index, 1.4938);
  EXPECT_EQ(spec.plate->material(550.0).absorption, 0.0);
  expect_fault("light_guide_plate: {refractive_index: 1.5, material: pmma}, " + kLeds, "material");
  EXPECT_NEAR(backlight_of("light_guide_plate: {absorption_per_m: 5}, " + kLeds).plate->material(550.0).absorption,
              0.005, 1e-15);
}

TEST(BacklightSpec, WithoutPlate) {
  const BacklightSpec spec = backlight_of("size: {length_mm: 20, width_mm: 10}, " + kBeam);
  EXPECT_FALSE(spec.plate);
  EXPECT_EQ(spec.area.max, core::Vec3(20.0, 10.0, 0.0));
  expect_fault("size: {length_mm: 20}, " + kLeds, "led_row needs a light_guide_plate");
  expect_fault("size: {length_mm: 20}, microstructure: {}, " + kBeam, "microstructure");
}

TEST(BacklightSpec, ReceiversFollowTheActiveArea) {
  const BacklightSpec spec =
      backlight_of(kPlate + "microstructure: {cells: [8, 4]}, films: [{kind: diffuser}], " + kLeds +
                   ", receivers: [{kind: luminance, cone_deg: 20, margins: {left_mm: 2, back_mm: 1}}]");
  EXPECT_EQ(spec.luminance.cells, core::CellGrid::over(8, 4, 2, 0, 20, 9));
  EXPECT_NEAR(spec.luminance.cone, 20.0 * core::kRadPerDeg, 1e-15);
  EXPECT_EQ(spec.luminance.estimator, LuminanceEstimator::kNextEvent);
  EXPECT_FALSE(spec.angular);
  const BacklightSpec counting = backlight_of(kPlate + "films: [{kind: diffuser}], " + kLeds +
                                              ", receivers: [{kind: luminance, estimator: counting}]");
  EXPECT_EQ(counting.luminance.estimator, LuminanceEstimator::kCounting);
}

TEST(BacklightSpec, NamesItsFaults) {
  expect_fault(kPlate + "films: []", "sources");
  expect_fault(kPlate + "sources: []", "sources");
  expect_fault(kPlate + kLeds + ", receivers: [{kind: luminance}, {kind: luminance}]", "one luminance receiver");
  expect_fault(kPlate + kLeds + ", receivers: [{kind: luminance, estimator: next_event}]", "estimator");
  expect_fault(kPlate + kLeds + ", receivers: [{kind: luminance, margins: {left_mm: 10, right_mm: 10}}]", "margins");
  expect_fault(kPlate + kLeds + ", receivers: [{kind: thermal}]", "kind");
  expect_fault(kPlate + "microstructure: {cells: [1.5, 2]}, " + kLeds, "cells");
  expect_fault(kPlate + "microstructure: {cells: [2000, 2000]}, " + kLeds, "1000000");
  expect_fault(kPlate + "microstructure: {face: left}, " + kLeds, "face");
  expect_fault(kPlate + "reflectors: {left: {gap_mm: 0.01}}, " + kLeds, "gap_mm");
  expect_fault(kPlate + "reflectors: {lefft: {}}, " + kLeds, "lefft");
  expect_fault(kPlate + "films: [{kind: glass}], " + kLeds, "kind");
  expect_fault("light_guide_plate: {length_mm: -1}, " + kLeds, "length_mm");
  expect_fault(kPlate + kLeds + ", receivers: [{kind: luminance, cone_deg: 0}]", "cone_deg");
}

/// Reading goes on after a fault, so that one pass finds all.
TEST(BacklightSpec, FindsAllFaultsAtOnce) {
  const std::string all =
      faults("light_guide_plate: {length_mm: -1, width_mm: x}, sources: [{kind: led_row, count: 0, gap_mm: 0}]");
  for (const char* key : {"length_mm", "width_mm", "count", "gap_mm"})
    EXPECT_NE(all.find(key), std::string::npos) << all;
}

}  // namespace
}  // namespace evenglow::tests
