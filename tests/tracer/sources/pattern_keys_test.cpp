#include "tracer/sources/pattern_keys.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tests/support/chi_square.h"
#include "tests/support/photometric_files.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"
#include "tests/support/z_test.h"

/// Seeds fixed; false alarm 1e-3 for each test.
namespace evenglow::tests {
namespace {

using namespace tracer;
using core::kPi;
using ::testing::HasSubstr;

class PatternKeysTest : public ::testing::Test {
 protected:
  BacklightSpec row(const std::string& keys) {
    return backlight_of(
        "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, sources: [{kind: led_row, count: 2, " +
        keys + "}]");
  }

  std::string fault(const std::string& keys) {
    try {
      row(keys);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "none";
  }

  std::string write(const std::string& name, const std::string& text) {
    write_text(folder_ / name, text);
    return "pattern_file: " + (folder_ / name).string();
  }

  TempFolder folder_;
};

/// Counts of the cosine with the normal, in bins that a Lambertian source fills alike (cos^2 is uniform), times
/// azimuths.
std::vector<double> lambertian_bins(const Source& source, int photons, std::uint64_t seed) {
  std::vector<double> counts(20 * 8, 0.0);
  core::PhotonRng rng({seed, 0, 0}, 0);
  for (int i = 0; i < photons; ++i) {
    const core::Vec3 k = source.emit(rng).light.frame.k;
    const int ring = std::min(19, static_cast<int>(20.0 * k.x() * k.x()));
    const int sector = std::min(7, static_cast<int>((std::atan2(k.z(), k.y()) / kPi + 1.0) * 4.0));
    counts[static_cast<std::size_t>(ring * 8 + sector)] += 1.0;
  }
  return counts;
}

TEST_F(PatternKeysTest, ALambertianFileIsTheLambertianPattern) {
  const auto lambert = [](double t, double) { return std::max(0.0, std::cos(t * core::kRadPerDeg)); };
  Ies ies;
  ies.intensity = lambert;
  Eulumdat ldt;
  ldt.intensity = lambert;
  std::string csv = "theta_deg,intensity\n";
  for (const double t : steps(0, 90, 1)) csv += text_of(t) + "," + text_of(lambert(t, 0)) + "\n";
  const std::string patterns[] = {"pattern: lambertian", "pattern: ies, " + write("l.ies", ies.text()),
                                  "pattern: eulumdat, " + write("l.ldt", ldt.text()),
                                  "pattern: tabulated, " + write("l.csv", csv)};
  constexpr int kPhotons = 200000;
  const std::vector<double> expected(160, kPhotons / 160.0);
  for (const std::string& pattern : patterns) {
    const auto counts = lambertian_bins(*row(pattern).sources.front(), kPhotons, 20260106);
    EXPECT_GT(chi_square_test(counts, expected).p_value, sidak(1e-3, 4)) << pattern;
  }
  const auto squared = lambertian_bins(*row("pattern: cos_n, exponent: 2").sources.front(), kPhotons, 20260106);
  EXPECT_LT(chi_square_test(squared, expected).p_value, 1e-6);
}

TEST_F(PatternKeysTest, FluxOfTheFileCountsUnlessTheRunFileGivesOne) {
  Ies ies;
  ies.intensity = [](double t, double) { return 2.0 * std::max(0.0, std::cos(t * core::kRadPerDeg)); };
  const std::string file = "pattern: ies, " + write("l.ies", ies.text());
  EXPECT_NEAR(row(file).sources.front()->flux(), 2 * 2.0 * kPi, 4e-3 * kPi);
  EXPECT_EQ(row(file + ", flux_lm: 5").sources.front()->flux(), 10.0);
  EXPECT_EQ(row("pattern: tabulated, " + write("s.csv", "theta_deg,intensity\n0,1\n90,1\n")).sources.front()->flux(),
            18.0);
  EXPECT_NEAR(
      row("pattern: tabulated, " + write("c.csv", "theta_deg,intensity_cd\n0,1\n90,1\n")).sources.front()->flux(),
      4.0 * kPi, 1e-9);
}

TEST_F(PatternKeysTest, WhatGoesBackIsLeftOutAndTold) {
  Eulumdat ldt;  // 1 cd all around
  const BacklightSpec spec = row("pattern: eulumdat, " + write("l.ldt", ldt.text()));
  EXPECT_NEAR(spec.sources.front()->flux(), 4.0 * kPi, 1e-9);
  EXPECT_THAT(spec.sources.front()->note(), HasSubstr("50 % of the flux of pattern_file goes beyond 90 degrees"));
  EXPECT_EQ(row("pattern: lambertian").sources.front()->note(), "");
}

/// cos^n falls to one half at the half angle.
TEST_F(PatternKeysTest, HalfAngle) {
  const double n = std::log(0.5) / std::log(std::cos(30 * core::kRadPerDeg));
  const BacklightSpec spec = row("pattern: cosine_power, half_angle_deg: 30");
  core::PhotonRng rng({20260107, 0, 0}, 0);
  constexpr int kPhotons = 100000;
  double sum = 0.0;
  for (int i = 0; i < kPhotons; ++i) sum += spec.sources.front()->emit(rng).light.frame.k.x();
  const double mean = (n + 1.0) / (n + 2.0);
  const double se = std::sqrt(((n + 1.0) / (n + 3.0) - mean * mean) / kPhotons);
  EXPECT_LT(std::abs(z_score({sum / kPhotons, se}, mean)), z_limit(1e-3, 1));
}

TEST_F(PatternKeysTest, TurningATableTurnsTheLight) {
  // All light to the right (azimuth 0 within 30 degrees): -y for the left edge; turned by 90 degrees it goes up.
  Ies ies;
  ies.horizontal = {0, 30, 31, 180};
  ies.intensity = [](double t, double p) { return t > 10 && p <= 30 ? 1.0 : 0.0; };
  const std::string file = "pattern: ies, " + write("r.ies", ies.text());
  core::PhotonRng rng({1, 0, 0}, 0);
  const BacklightSpec right = row(file);
  const BacklightSpec up = row(file + ", pattern_turn_deg: 90");
  for (int i = 0; i < 1000; ++i) {
    const core::Vec3 k = right.sources.front()->emit(rng).light.frame.k;
    ASSERT_LT(k.y(), -std::abs(k.z()));
    const core::Vec3 turned = up.sources.front()->emit(rng).light.frame.k;
    ASSERT_GT(turned.z(), std::abs(turned.y()));
  }
}

TEST_F(PatternKeysTest, FacesTakePatternsToo) {
  Ies ies;
  const BacklightSpec spec = backlight_of(
      "size: {length_mm: 20, width_mm: 10}, sources: [{kind: lambertian_face, face: "
      "bottom, pattern: ies, " +
      write("l.ies", ies.text()) + "}]");
  EXPECT_NEAR(spec.sources.front()->flux(), 2.0 * kPi, 1e-9);
}

TEST_F(PatternKeysTest, Faults) {
  EXPECT_THAT(fault("pattern: ies"), HasSubstr("pattern_file: must be given"));
  EXPECT_THAT(fault("pattern: ies, pattern_file: none.ies"), HasSubstr("must be an existing file"));
  EXPECT_THAT(fault("pattern_file: none.ies"), HasSubstr("pattern_file: unknown key"));
  EXPECT_THAT(fault("pattern: cos_n, exponent: 2, half_angle_deg: 30"), HasSubstr("got both"));
  EXPECT_THAT(fault("pattern: ies, " + write("bad.ies", "no\n")), HasSubstr("bad.ies:2:1: must go on with the line"));
  Ies dark;
  dark.intensity = [](double, double) { return 0.0; };
  EXPECT_THAT(fault("pattern: ies, " + write("dark.ies", dark.text())), HasSubstr("must hold light within 90 degrees"));
  Ies behind;
  behind.vertical = steps(90, 180, 5);
  EXPECT_THAT(fault("pattern: ies, " + write("b.ies", behind.text())), HasSubstr("must hold light within 90 degrees"));
}

}  // namespace
}  // namespace evenglow::tests
