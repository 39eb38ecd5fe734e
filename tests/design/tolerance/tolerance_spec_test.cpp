#include "design/tolerance/tolerance_spec.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/config_reading.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"

namespace evenglow::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr const char* kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, microstructure: {cells: [10, 10]}, "
    "sources: [{kind: led_row, count: 2, pitch_mm: 5}, {kind: lambertian_face, face: right}], films: [{kind: lpp}]";

core::Lines faults(const std::string& tolerance, ToleranceSpec* spec = nullptr,
                   const std::string& backlight = kBacklight) {
  const tracer::BacklightSpec parts = tests::backlight_of(backlight);
  return core::faults_of("tolerance: " + tolerance + "\n", [&](const core::ConfigNode& root) {
    const ToleranceSpec read = read_tolerance(root, parts);
    if (spec != nullptr) *spec = read;
  });
}

core::Lines variation_faults(const std::string& variation) {
  return faults("{variations: [" + variation + "]}");
}

TEST(ToleranceSpec, IsRead) {
  ToleranceSpec spec;
  EXPECT_THAT(faults("{samples: 50, seed: 3, photons: 2e5, reference_photons: 1e6, common_numbers: true, "
                     "limits: {uniformity_9: {min: 0.8}, rms_corrected: {max: 0.03}}, variations: ["
                     "{kind: dot_growth_um, normal: 1}, {kind: dot_region_um, normal: 2, length_mm: 5}, "
                     "{kind: led_flux, choices: [0.9, 1.1], source: 0}, {kind: film_angle_deg, film: 0, uniform: 2}, "
                     "{kind: key, key: backlight.light_guide_plate.thickness_mm, normal: 0.02, relative: true}]}",
                     &spec),
              IsEmpty());
  EXPECT_EQ(spec.samples, 50);
  EXPECT_EQ(spec.seed, 3U);
  EXPECT_EQ(spec.photons, 200000U);
  EXPECT_EQ(spec.reference, 1000000U);
  EXPECT_TRUE(spec.common_numbers);
  ASSERT_THAT(spec.limits, SizeIs(2));
  EXPECT_EQ(spec.limits[0].figure, "rms_corrected");
  EXPECT_EQ(spec.limits[1].min, 0.8);
  ASSERT_THAT(spec.variations, SizeIs(5));
  EXPECT_EQ(spec.variations[0].kind, VariationKind::dot_growth);
  EXPECT_EQ(spec.variations[1].length, 5.0);
  EXPECT_EQ(title_of(spec.variations[2]), "led_flux of sources[0]");
  EXPECT_EQ(title_of(spec.variations[3]), "film_angle_deg of films[0]");
  EXPECT_EQ(title_of(spec.variations[4]), "backlight.light_guide_plate.thickness_mm");
  EXPECT_TRUE(spec.variations[4].relative);
}

TEST(ToleranceSpec, KeysOfGridsAndOfOtherPartsAreRefused) {
  for (const char* key : {"backlight.light_guide_plate.length_mm", "backlight.microstructure.density",
                          "backlight.microstructure.cells[0]", "backlight.receivers[0].cells[0]", "design.stop_rms",
                          "dots.diameter_um", "trace.photons", "output", "backlight.size.width_mm"}) {
    EXPECT_THAT(variation_faults(std::string("{kind: key, key: \"") + key + "\", normal: 0.1, mean: 1}"), SizeIs(1))
        << key;
  }
  EXPECT_THAT(variation_faults("{kind: key, key: backlight.light_guide_plate.thickness_mm, normal: 0.1}"), IsEmpty());
}

TEST(ToleranceSpec, ANumberVariesOnce) {
  const std::string haze = "{kind: key, key: \"backlight.films[0].axis_deg\", choices: [10, 45]}";
  EXPECT_THAT(variation_faults(haze + ", " + haze),
              ElementsAre(HasSubstr("must not vary what another variation varies")));
  EXPECT_THAT(variation_faults(haze + ", {kind: film_angle_deg, film: 0, normal: 1}"), SizeIs(1));
  EXPECT_THAT(variation_faults("{kind: led_flux, normal: 0.1}, {kind: key, key: "
                               "\"backlight.sources[0].flux_factors[0]\", choices: [1, 2]}"),
              SizeIs(1));
}

TEST(ToleranceSpec, IsEmptyByDefault) {
  ToleranceSpec spec;
  EXPECT_THAT(faults("{}", &spec), IsEmpty());
  EXPECT_THAT(spec.variations, IsEmpty());
  EXPECT_EQ(spec.samples, 200);
}

TEST(ToleranceSpec, TakesTheDensityOfAResult) {
  const tests::TempFolder folder;
  const std::string path = folder.path().string();
  EXPECT_THAT(faults("{result: " + path + "}"), ElementsAre(HasSubstr("tolerance.result")));
  std::ofstream(folder.path() / "density.csv") << "0.1,0.2\n0.3,0.4\n";
  ToleranceSpec spec;
  EXPECT_THAT(faults("{result: " + path + "}", &spec), IsEmpty());
  EXPECT_EQ(spec.density.nx, 2);
}

TEST(ToleranceSpec, FaultsOfLimits) {
  EXPECT_THAT(faults("{limits: {rms: {max: 0.1}}}"),
              ElementsAre(HasSubstr("limits.rms: unknown key, known here: rms_corrected")));
  EXPECT_THAT(faults("{limits: {efficiency: {}}}"), ElementsAre(HasSubstr("must have min, max or both")));
  EXPECT_THAT(faults("{limits: {efficiency: {min: 0.5, max: 0.4}}}"), ElementsAre(HasSubstr("must be less than max")));
}

TEST(ToleranceSpec, FaultsOfVariations) {
  EXPECT_THAT(variation_faults("{normal: 1}"), ElementsAre(HasSubstr("kind")));
  EXPECT_THAT(variation_faults("{kind: dot_growth, normal: 1}"), ElementsAre(HasSubstr("dot_growth_um")));
  EXPECT_THAT(variation_faults("{kind: dot_size_um, uniform: 1}"), testing::Contains(HasSubstr("normal")));
  EXPECT_THAT(variation_faults("{kind: led_flux, normal: 0.3, mean: 0.5}"),
              ElementsAre(HasSubstr("must stay above 0")));
  EXPECT_THAT(variation_faults("{kind: led_flux, normal: 0.05, source: 1}"),
              ElementsAre(HasSubstr("must name a led_row")));
  EXPECT_THAT(variation_faults("{kind: film_angle_deg, film: 1, normal: 1}"),
              ElementsAre(HasSubstr("must lie in [0, 0]")));
  EXPECT_THAT(variation_faults("{kind: key, key: trace.photons, normal: 1}"),
              ElementsAre(HasSubstr("must be a key of the backlight")));
  EXPECT_THAT(variation_faults("{kind: key, key: \"a[\", normal: 1}"),
              ElementsAre(HasSubstr("must be the path of a key")));
  EXPECT_THAT(variation_faults("{kind: key, key: backlight.b, choices: [1, 2], relative: true}"),
              ElementsAre(HasSubstr("relative")));
  // Cells of 2 mm x 1 mm: a quarter of the shorter side.
  EXPECT_THAT(variation_faults("{kind: dot_place_um, normal: 250}"), IsEmpty());
  EXPECT_THAT(variation_faults("{kind: dot_place_um, normal: 251}"), ElementsAre(HasSubstr("must be at most 250 um")));
}

TEST(ToleranceSpec, WhatVariesMustBeThere) {
  const std::string bare =
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, sources: [{kind: lambertian_face}]";
  const auto of = [&](const std::string& v) { return faults("{variations: [" + v + "]}", nullptr, bare); };
  EXPECT_THAT(of("{kind: dot_growth_um, normal: 1}"), ElementsAre(HasSubstr("no microstructure")));
  EXPECT_THAT(of("{kind: led_flux, normal: 0.1}"), ElementsAre(HasSubstr("no led_row")));
  EXPECT_THAT(of("{kind: film_angle_deg, film: 0, normal: 1}"), ElementsAre(HasSubstr("which has none")));
}

}  // namespace
}  // namespace evenglow::design
