#include "design/engine/traced_metrology.h"

#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "core/light/cie_1931.h"
#include "core/light/color.h"
#include "design/engine/traced_model.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Color and hot spots of traced backlights. Seeds fixed; false alarms 1e-3 for each test.
namespace evenglow::design {
namespace {

using tests::Traced;

/// Two faces of one wavelength each: the tristimulus values of a lumen of one wavelength are its matching functions
/// over their y, so u' and v' of the mixture are known.
TEST(TracedMetrology, TwoWavelengthsOnALambertianFace) {
  const std::string face = "{kind: lambertian_face, face: bottom, ";
  const Traced traced("size: {length_mm: 20, width_mm: 10}, sources: [" + face +
                          "flux_lm: 30, spectrum: {kind: monochromatic, wavelength_nm: 465}}, " + face +
                          "flux_lm: 170, spectrum: {kind: monochromatic, wavelength_nm: 580}}], receivers: [{kind: "
                          "luminance, cells: [4, 2], cone_deg: 40}, {kind: color}]",
                      {200'000, 5, 100, 1});
  const Observation observation = make_observation(traced.scene(), traced.result());
  const auto color = traced_color(traced.scene(), observation);
  ASSERT_TRUE(color);
  const core::Vec3 blue = core::color_matching(465.0), yellow = core::color_matching(580.0);
  const core::Vec2 uv = core::chromaticity_uv(30.0 * blue / blue.y() + 170.0 * yellow / yellow.y());
  const double limit = tests::z_limit(1e-3, 18) * 1.05;
  EXPECT_NEAR(color->emitted.u.value, uv.x(), 1e-9);
  EXPECT_NEAR(color->emitted.v.value, uv.y(), 1e-9);
  EXPECT_LT(std::abs(tests::z_score(color->mean.u, uv.x())), limit);
  EXPECT_LT(std::abs(tests::z_score(color->mean.v, uv.y())), limit);
  EXPECT_LT(color->mean.u.se, 0.002);
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LT(std::abs(tests::z_score({color->u.values[i], color->u_se.values[i]}, uv.x())), limit) << i;
    EXPECT_LT(std::abs(tests::z_score({color->v.values[i], color->v_se.values[i]}, uv.y())), limit) << i;
  }
  EXPECT_LT(color->rms_corrected.value, 3.5 * color->rms_corrected.se);
  EXPECT_GT(color->rms, 0.0);
}

/// One wavelength, hence one band: the color is that of the line, without noise.
TEST(TracedMetrology, OneWavelengthHasItsOwnColor) {
  const Traced traced(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom, spectrum: {kind: "
      "monochromatic, wavelength_nm: 465}}], receivers: [{kind: luminance, cells: [2, 1], cone_deg: 40}, {kind: "
      "color}]",
      {10'000, 5, 10, 1});
  const auto color = traced_color(traced.scene(), make_observation(traced.scene(), traced.result()));
  ASSERT_TRUE(color);
  const core::Vec2 xy = core::chromaticity_xy(core::color_matching(465.0));
  EXPECT_NEAR(color->mean.x.value, xy.x(), 1e-9);
  EXPECT_NEAR(color->mean.y.value, xy.y(), 1e-9);
  EXPECT_NEAR(color->mean.x.se, 0.0, 1e-9);
  EXPECT_NEAR(color->max.value, 0.0, 1e-9);
}

TEST(TracedMetrology, NoColorUnlessAskedFor) {
  const Traced traced("size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom}]",
                      {10'000, 5, 10, 1});
  const Observation observation = make_observation(traced.scene(), traced.result());
  EXPECT_FALSE(traced_color(traced.scene(), observation));
  EXPECT_TRUE(traced_hot_spots(traced.scene(), observation).empty());
}

/// A clear plate with dots: the LEDs of both rows show at their edge and not far from it.
TEST(TracedMetrology, HotSpotsOfTwoRows) {
  const Traced traced(
      "light_guide_plate: {length_mm: 40, width_mm: 20, thickness_mm: 1}, microstructure: {cells: [1, 1], density: "
      "0.3}, sources: [{kind: lambertian_face, face: left}, {kind: led_row, edge: right, count: 2, pitch_mm: 10}, "
      "{kind: led_row, edge: front, count: 3, pitch_mm: 12}], reflectors: {bottom: {}}, films: [{kind: diffuser}], "
      "receivers: [{kind: luminance, cells: [20, 20], cone_deg: 30}]",
      {200'000, 6, 50, 1});
  const auto rows = traced_hot_spots(traced.scene(), make_observation(traced.scene(), traced.result()));
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0].source, 1U);
  EXPECT_EQ(rows[0].edge, "right");
  EXPECT_EQ(rows[0].gaps, 1);
  EXPECT_NEAR(rows[0].gap_width, 10.0 - 2.6, 1e-9);
  EXPECT_NEAR(rows[0].lines.front().distance, 1.0, 1e-9);
  EXPECT_EQ(rows[1].edge, "front");
  EXPECT_EQ(rows[1].gaps, 2);
  EXPECT_NEAR(rows[1].lines.front().distance, 0.5, 1e-9);
  for (const HotSpots& row : rows) {
    const core::Estimate first = row.lines.front().ratio, far = row.lines[10].ratio;
    EXPECT_GT(first.value, 1.0 + 5.0 * first.se) << row.edge;
    EXPECT_LT(far.value, 1.2) << row.edge;
  }
}

/// Angles of a source of the power n of the cosine: the luminance falls as cos^(n - 1).
TEST(TracedMetrology, HalfAnglesOfACosinePower) {
  const Traced traced(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: bottom, pattern: cosine_power, "
      "exponent: 4}], receivers: [{kind: angular, polar_count: 30, azimuth_count: 8, at: center}]",
      {1'000'000, 7, 50, 1});
  const Observation observation = make_observation(traced.scene(), traced.result());
  ASSERT_TRUE(observation.angular && observation.angular->horizontal && observation.angular->vertical);
  const double expected = std::acos(std::pow(0.5, 1.0 / 3.0)) / core::kRadPerDeg;
  for (const auto& angles : {*observation.angular->horizontal, *observation.angular->vertical}) {
    // The greatest luminance is that of a bin that the noise favors, and the innermost bins are 3 degrees wide: the
    // limit leaves 0.3 degrees to that.
    EXPECT_NEAR(angles.to_deg.value, expected, 0.3 + 3.3 * angles.to_deg.se);
    EXPECT_NEAR(angles.from_deg.value, -expected, 0.3 + 3.3 * angles.from_deg.se);
    EXPECT_LT(angles.width_deg.se, 1.0);
  }
  ASSERT_EQ(observation.angular_spots.size(), 1U);
  EXPECT_NEAR(observation.angular_spots[0].x, 10.0, 1e-9);
  EXPECT_GT(observation.angular_spots[0].diameter, 1.0);
}

}  // namespace
}  // namespace evenglow::design
