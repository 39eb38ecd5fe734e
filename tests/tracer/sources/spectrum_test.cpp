#include "tracer/sources/spectrum.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
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
  EXPECT_THAT(faults_of("{kind: rgb, powers: [0, 0, 0]}"), HasSubstr("must not all be 0"));
  EXPECT_THAT(faults_of("{kind: monochromatic, wavelength_nm: 300}"), HasSubstr("wavelength_nm"));
  EXPECT_THAT(faults_of("{kind: neon}"), HasSubstr("must be one of monochromatic"));
}

}  // namespace
}  // namespace evenglow::tracer
