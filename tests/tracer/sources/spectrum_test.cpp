#include "tracer/sources/spectrum.h"

#include <algorithm>
#include <string>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/light/color.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;

/// The spectrum of `source: {spectrum: ...}`; throws all faults.
Spectrum spectrum_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("source: {spectrum: " + yaml + "}", "run.yaml");
  Spectrum spectrum = read_spectrum(document.root().map("source", ""));
  document.finish();
  return spectrum;
}

std::string faults_of(const std::string& yaml) {
  try {
    spectrum_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(Spectrum, APeakHasItsWidthAtHalfHeight) {
  EXPECT_DOUBLE_EQ(led_peak(450.0, 450.0, 20.0), 1.0);
  EXPECT_NEAR(led_peak(440.0, 450.0, 20.0), 0.5, 1e-12);
  EXPECT_NEAR(led_peak(460.0, 450.0, 20.0), 0.5, 1e-12);
}

TEST(Spectrum, WithoutTheKeyItIs550) {
  const core::ConfigDocument document = core::ConfigDocument::parse("source: {}", "run.yaml");
  const Spectrum spectrum = read_spectrum(document.root().map("source", ""));
  EXPECT_THAT(spectrum.wavelength, ::testing::ElementsAre(550.0));
}

TEST(Spectrum, AWhiteLedHasItsShareOfBlue) {
  const Spectrum spectrum = spectrum_of("{kind: white_led, blue_nm: 450, phosphor_nm: 580, blue_share: 0.4}");
  double blue = 0.0, all = 0.0;
  for (std::size_t i = 0; i < spectrum.wavelength.size(); ++i) {
    all += spectrum.power[i];
    if (spectrum.wavelength[i] < 480.0) blue += spectrum.power[i];
  }
  EXPECT_NEAR(blue / all, 0.4, 0.02);  // the phosphor reaches a little below 480 nm
}

/// The keys say what a spectrometer shows: peak and full width of the power per nm. Parabola through the three largest
/// lines, linear interpolation at half height; a scale of wavenumbers with its Jacobian puts the peak at 551 nm.
TEST(Spectrum, APhosphorHasThePeakAndTheWidthOfItsKeys) {
  for (const auto& [center, fwhm] : {std::pair{560.0, 120.0}, {600.0, 60.0}, {550.0, 200.0}}) {
    const Spectrum s = spectrum_of("{kind: white_led, blue_share: 0, phosphor_nm: " + std::to_string(center) +
                                   ", phosphor_fwhm_nm: " + std::to_string(fwhm) + "}");
    ASSERT_EQ(s.wavelength.size(), 401U);
    const auto top = static_cast<std::size_t>(std::max_element(s.power.begin(), s.power.end()) - s.power.begin());
    EXPECT_EQ(s.wavelength[top], center);
    const double half = 0.5 * s.power[top];
    double low = 0.0, high = 0.0;
    for (std::size_t i = 1; i < s.power.size(); ++i) {
      const double at = s.wavelength[i - 1] + (half - s.power[i - 1]) / (s.power[i] - s.power[i - 1]);
      if (s.power[i - 1] < half && s.power[i] >= half) low = at;
      if (s.power[i - 1] >= half && s.power[i] < half) high = at;
    }
    EXPECT_NEAR(high - low, fwhm, 0.02);
    EXPECT_LT(center - low, high - center);  // steeper on the blue side
  }
}

/// The side-view part says about 7000 K. Nearest point of the Planckian locus, computed apart: 7191 K.
TEST(Spectrum, TheWhiteLedOfThePartsHasItsColorTemperature) {
  const Spectrum s = spectrum_of(
      "{kind: white_led, blue_nm: 450, blue_fwhm_nm: 20, phosphor_nm: 560, phosphor_fwhm_nm: 125, blue_share: 0.31}");
  EXPECT_NEAR(core::color_temperature(s.xyz()).kelvin, 7191.0, 10.0);
}

/// A line of 0.6 nm between whole nanometers, and a spectrum in steps of 0.25 nm that alternates: both keep their
/// power.
TEST(Spectrum, ATableLosesNoNarrowLine) {
  const tests::TempFolder folder;
  tests::write_text(folder / "line.csv", "wavelength_nm,power\n550.2,0\n550.5,1\n550.8,0\n");
  const Spectrum line = spectrum_of("{kind: table, file: '" + (folder / "line.csv").string() + "'}");
  double sum = 0.0;
  for (const double power : line.power) sum += power;
  EXPECT_NEAR(sum, 0.3, 1e-12);
  std::string comb = "wavelength_nm,power\n";
  for (int i = 0; i <= 400; ++i) comb += std::to_string(500.0 + 0.25 * i) + (i % 4 == 0 ? ",1\n" : ",0\n");
  tests::write_text(folder / "comb.csv", comb);
  const Spectrum teeth = spectrum_of("{kind: table, file: '" + (folder / "comb.csv").string() + "'}");
  EXPECT_NEAR(teeth.power[50], 0.25, 1e-12);
}

TEST(Spectrum, ATableIsLinearBetweenItsRows) {
  const tests::TempFolder folder;
  tests::write_text(folder / "s.csv", "# nm\nwavelength_nm,power\n500,1\n510,3\n");
  const Spectrum spectrum = spectrum_of("{kind: table, file: '" + (folder / "s.csv").string() + "'}");
  ASSERT_EQ(spectrum.wavelength.size(), 11U);
  EXPECT_DOUBLE_EQ(spectrum.wavelength[5], 505.0);
  EXPECT_NEAR(spectrum.power[5], 2.0, 1e-12);
}

TEST(Spectrum, WrongOnesAreRefused) {
  const tests::TempFolder folder;
  tests::write_text(folder / "back.csv", "wavelength_nm,power\n510,1\n500,3\n");
  tests::write_text(folder / "dark.csv", "wavelength_nm,power\n500,0\n510,0\n");
  EXPECT_THAT(faults_of("{kind: table, file: '" + (folder / "back.csv").string() + "'}"),
              HasSubstr("must be larger than that of the row before (510), got 500"));
  EXPECT_THAT(faults_of("{kind: table, file: '" + (folder / "dark.csv").string() + "'}"),
              HasSubstr("must hold some visible light"));
  tests::write_text(folder / "one.csv", "wavelength_nm,power\n532.5,1\n");
  EXPECT_THAT(faults_of("{kind: table, file: '" + (folder / "one.csv").string() + "'}"),
              HasSubstr("must hold two rows at least"));
  EXPECT_THAT(faults_of("{kind: rgb, powers: [0, 0, 0]}"), HasSubstr("must not all be 0"));
  EXPECT_THAT(faults_of("{kind: monochromatic, wavelength_nm: 300}"), HasSubstr("wavelength_nm"));
  EXPECT_THAT(faults_of("{kind: neon}"), HasSubstr("must be one of monochromatic"));
}

}  // namespace
}  // namespace evenglow::tracer
