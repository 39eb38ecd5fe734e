#include "tracer/scene/receiver_keys.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

std::string lit(const std::string& receivers) {
  return "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], receivers: [" +
         receivers + "]";
}

void expect_fault(const std::string& receivers, const std::string& part) {
  std::string message;
  try {
    backlight_of(lit(receivers));
  } catch (const core::ConfigError& error) {
    message = error.what();
  }
  EXPECT_NE(message.find(part), std::string::npos) << receivers << "\n" << message;
}

TEST(ReceiverKeys, DirectionOfView) {
  const BacklightSpec spec = backlight_of(lit("{kind: luminance, cone_deg: 5, direction_deg: [30, -90]}"));
  EXPECT_NEAR(spec.luminance.polar, 30.0 * core::kRadPerDeg, 1e-15);
  EXPECT_NEAR(spec.luminance.azimuth, -90.0 * core::kRadPerDeg, 1e-15);
  EXPECT_EQ(backlight_of(lit("{kind: luminance, cone_deg: 90}")).luminance.polar, 0.0);
  EXPECT_NO_THROW(backlight_of(lit("{kind: luminance, cone_deg: 9, direction_deg: [80, 0]}")));
  expect_fault("{kind: luminance, cone_deg: 10, direction_deg: [80, 0]}",
               "backlight.receivers[0].direction_deg: the polar angle and the cone's half angle (10 degrees) must not "
               "be more than 89 degrees together, got 90");
  expect_fault("{kind: luminance, direction_deg: [-5, 0]}", "the polar angle must not be negative, got -5");
  expect_fault("{kind: luminance, direction_deg: [5]}", "direction_deg");
  expect_fault("{kind: luminance, direction_deg: [5, 400]}", "direction_deg");
}

TEST(ReceiverKeys, SeveralDirectionsOfView) {
  EXPECT_TRUE(backlight_of(lit("{kind: luminance}")).luminance.views.empty());
  const auto views = backlight_of(lit("{kind: luminance, views: [{direction_deg: [0, 0], weight: 6}, {direction_deg: "
                                      "[30, 90], weight: 2}]}"))
                         .luminance.views;
  ASSERT_EQ(views.size(), 2U);
  EXPECT_DOUBLE_EQ(views[0].share, 0.75);
  EXPECT_DOUBLE_EQ(views[1].share, 0.25);
  EXPECT_NEAR(views[1].polar, 30.0 * core::kRadPerDeg, 1e-15);
  EXPECT_NEAR(views[1].azimuth, 90.0 * core::kRadPerDeg, 1e-15);
  expect_fault("{kind: luminance, views: [{weight: 1}]}", "receivers[0].views[0].direction_deg");
  expect_fault("{kind: luminance, views: [{direction_deg: [0, 0], weight: 0}]}", "receivers[0].views[0].weight");
  expect_fault("{kind: luminance, views: [{direction_deg: [85, 0]}]}",
               "receivers[0].views[0].direction_deg: the polar angle and the cone's half angle");
  expect_fault("{kind: luminance, direction_deg: [10, 0], views: [{direction_deg: [0, 0]}]}",
               "receivers[0].direction_deg: must be left out beside views, got both");
  expect_fault("{kind: luminance, views: [{direction_deg: [0, 0]}], pupil: {distance_mm: 500, diameter_mm: 5}}",
               "receivers[0].pupil: must be left out beside views, got both");
}

TEST(ReceiverKeys, Pupil) {
  EXPECT_FALSE(backlight_of(lit("{kind: luminance}")).luminance.pupil);
  const auto pupil =
      backlight_of(lit("{kind: luminance, margins: {left_mm: 4}, pupil: {distance_mm: 500, diameter_mm: 5}}"))
          .luminance.pupil;
  ASSERT_TRUE(pupil);
  EXPECT_EQ(pupil->distance, 500.0);
  EXPECT_EQ(pupil->diameter, 5.0);
  EXPECT_NEAR(pupil->x, 12.0, 1e-12);  // of the active area
  EXPECT_NEAR(pupil->y, 5.0, 1e-12);
  EXPECT_EQ(backlight_of(lit("{kind: luminance, pupil: {distance_mm: 500, diameter_mm: 5, at: [-30, 2]}}"))
                .luminance.pupil->x,
            -30.0);
  expect_fault("{kind: luminance, pupil: {distance_mm: 500}}", "receivers[0].pupil.diameter_mm");
  expect_fault("{kind: luminance, pupil: {distance_mm: 0, diameter_mm: 5}}", "receivers[0].pupil.distance_mm");
  expect_fault("{kind: luminance, pupil: {distance_mm: 500, diameter_mm: 0}}", "receivers[0].pupil.diameter_mm");
  expect_fault("{kind: luminance, pupil: {distance_mm: 500, diameter_mm: 5, at: [1]}}", "receivers[0].pupil.at");
  expect_fault("{kind: luminance, pupil: 5}", "receivers[0].pupil");
  expect_fault("{kind: luminance, cone_deg: 5, pupil: {distance_mm: 500, diameter_mm: 5}}",
               "receivers[0].cone_deg: must be left out beside a pupil");
  expect_fault("{kind: luminance, direction_deg: [5, 5], pupil: {distance_mm: 500, diameter_mm: 5}}",
               "receivers[0].direction_deg: must be left out beside a pupil");
}

TEST(ReceiverKeys, SpotsOfTheAngularReceiver) {
  EXPECT_EQ(backlight_of(lit("{kind: angular}")).angular->spots, 0);
  EXPECT_EQ(backlight_of(lit("{kind: angular, at: all}")).angular->spots, 0);
  EXPECT_EQ(backlight_of(lit("{kind: angular, at: center}")).angular->spots, 1);
  const BacklightSpec nine = backlight_of(lit("{kind: angular, at: 9}"));
  EXPECT_EQ(nine.angular->spots, 9);
  EXPECT_NEAR(nine.angular->spot_radius, 0.04 * std::hypot(20.0, 10.0), 1e-12);
  EXPECT_EQ(backlight_of(lit("{kind: angular, at: 13, spot_mm: 1.5}")).angular->spot_radius, 0.75);
  expect_fault("{kind: angular, at: 10}", "backlight.receivers[0].at");
  expect_fault("{kind: angular, at: 9, spot_mm: 2.1}",
               "spot_mm: must be at most a fifth of the shorter side of the active area (2 mm), got 2.1 mm");
  expect_fault("{kind: angular, at: 13, polar_count: 90, azimuth_count: 90}", "100000 bins");
}

/// The active area is that of the luminance receiver, wherever in the list it stands.
TEST(ReceiverKeys, SpotsLieInTheActiveArea) {
  const Scene scene =
      scene_of(lit("{kind: angular, at: center}, {kind: luminance, margins: {left_mm: 10, back_mm: 2}}"));
  ASSERT_EQ(scene.angular->spots().size(), 1U);
  EXPECT_NEAR(scene.angular->spots()[0].x, 15.0, 1e-12);
  EXPECT_NEAR(scene.angular->spots()[0].y, 4.0, 1e-12);
  EXPECT_NEAR(scene.angular->spots()[0].radius, 0.04 * std::hypot(10.0, 8.0), 1e-12);
}

TEST(ReceiverKeys, NoneMeansTheThreeUsualKinds) {
  const BacklightSpec spec =
      backlight_of("size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}]");
  EXPECT_TRUE(spec.angular);
  EXPECT_FALSE(spec.color);
  EXPECT_TRUE(backlight_of(lit("{kind: color}")).color);
  EXPECT_FALSE(backlight_of(lit("{kind: color}")).angular);
}

/// What scatters over less than the cone is counted, unless next-event is asked for or nothing else can be done.
TEST(ReceiverKeys, EstimatorByLobeAndCone) {
  const auto read = [](const std::string& film, const std::string& receiver) {
    return backlight_of(
               "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}], films: [" +
               film + "], receivers: [{kind: luminance, " + receiver + "}]")
        .luminance;
  };
  const std::string narrow = "{kind: diffuser, fwhm_deg: 8}", wide = "{kind: diffuser, fwhm_deg: 40}";
  EXPECT_EQ(read(narrow, "cone_deg: 10").estimator, LuminanceEstimator::kCounting);
  EXPECT_EQ(read(narrow, "cone_deg: 5").estimator, LuminanceEstimator::kNextEvent);
  EXPECT_EQ(read(wide, "cone_deg: 10").estimator, LuminanceEstimator::kNextEvent);
  EXPECT_EQ(read(wide, "cone_deg: 50").estimator, LuminanceEstimator::kCounting);
  EXPECT_EQ(read(wide, "cone_deg: 10, estimator: counting").estimator, LuminanceEstimator::kCounting);
  EXPECT_EQ(read(narrow + ", " + wide, "cone_deg: 10").estimator, LuminanceEstimator::kNextEvent);
  for (const char* asked :
       {"cone_deg: 0", "cone_deg: 10, estimator: next_event", "pupil: {distance_mm: 500, diameter_mm: 5}"}) {
    const LuminanceReceiverSpec spec = read(narrow, asked);
    EXPECT_EQ(spec.estimator, LuminanceEstimator::kNextEvent) << asked;
    EXPECT_EQ(spec.least_lobe, 0.0) << asked;
  }
}

}  // namespace
}  // namespace evenglow::tests
