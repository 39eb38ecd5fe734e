#include <cmath>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "tests/support/estimator_comparison.h"
#include "tests/support/films.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// The next-event estimate against plain counting, in runs of their own: mean luminance within its errors, and a
/// chi-square over all cells that is neither too large (another map) nor too small (errors overstated). Seeds fixed;
/// false alarm 1e-3 for each test of the quick suite over all its scenes.
namespace evenglow::tests {
namespace {

using namespace tracer;

std::string stack(const std::string& films) {
  return "size: {length_mm: 20, width_mm: 10}, reflectors: {bottom: {reflectance: 0.9, gap_mm: 1}, left: {}, right: "
         "{kind: mirror}}, "
         "sources: [{kind: lambertian_face, face: bottom}], films: [" +
         films + "]";
}

const std::string kDiffuser =
    "{kind: diffuser, gap_mm: 1, transmittance: 0.7, reflectance: 0.25, haze: 0.8, fwhm_deg: 50, depolarization: 0.3}";
const std::string kLpp = "{kind: lpp, axis_deg: 30, reflectance: 0.1}";

std::string table_dbef() {
  return "{kind: dbef, axis_deg: 30, table: \"" + data_file("dbef.csv") + "\", hemispherical: \"" +
         data_file("dbef_hemispherical.csv") + "\"}";
}

std::string small_plate() {
  return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1}, microstructure: {cells: [8, 8], density: "
         "0.3}, "
         "sources: [{kind: led_row, count: 3}], reflectors: {bottom: {}, left: {reflectance: 0.7}, right: {}, front: "
         "{}, back: {}}, films: [" +
         kDiffuser + ", " + table_dbef() + "]";
}

void check(const std::string& backlight, std::uint64_t photons,
           const std::string& receiver = "cells: [8, 8], cone_deg: 30", const char* estimator = "next_event") {
  constexpr std::size_t kScenes = 20;
  const EstimatorComparison c =
      compare_estimators(backlight, receiver, receiver, {photons, 101, 200, 1}, {photons, 202, 200, 1}, estimator);
  std::printf("z %.2f, chi2/dof %.3f, relative error of the difference %.4f\n", c.z_mean, c.chi2 / c.cells, c.se_mean);
  EXPECT_LT(std::abs(c.z_mean), z_limit(0.5e-3, kScenes));
  const double chance = sidak(0.25e-3, kScenes);
  EXPECT_GT(c.chance, chance) << c.chi2 / c.cells;
  EXPECT_LT(c.chance, 1.0 - chance) << c.chi2 / c.cells;
  EXPECT_LT(c.se_mean, 0.013);
}

TEST(Estimators, Diffuser) {
  check(stack(kDiffuser), 150'000);
}
TEST(Estimators, DiffuserUnderLpp) {
  check(stack(kDiffuser + ", " + kLpp), 300'000);
}
TEST(Estimators, DiffuserUnderSheetsAndLpp) {
  const std::string sheet = "{kind: sheet, refractive_index: 1.7, thickness_mm: 1.5, absorption_per_m: 100}";
  check(stack(kDiffuser + ", " + sheet + ", " + sheet + ", " + kLpp), 300'000);
}
/// Strong reflections between the films above: 1 / (1 - 0.45 x 0.35), 19 % more than without.
TEST(Estimators, IdealDbefOnADiffuser) {
  check(
      stack(kDiffuser +
            ", {kind: dbef, axis_deg: 30, transmittance_block: 0.05, reflectance_pass: 0.45, transmittance_pass: 0.5}, "
            "{kind: lpp, axis_deg: 30, k1: 0.6, reflectance: 0.35}"),
      300'000);
}
TEST(Estimators, TabulatedDbefOnADiffuser) {
  check(stack(kDiffuser + ", " + table_dbef()), 200'000);
}
TEST(Estimators, TabulatedDbefUnderLpp) {
  check(stack(kDiffuser + ", " + table_dbef() + ", " + kLpp), 200'000);
}
TEST(Estimators, TabulatedDbefUnderSheet) {
  check(stack(table_dbef() + ", {kind: sheet, gap_mm: 0.5, thickness_mm: 2}"), 150'000);
}
/// Much of the scattered light meets a mirror before it reaches the film high above: that part is counted.
TEST(Estimators, FilmHighAboveBetweenMirrors) {
  const std::string mirror = "{kind: mirror, reflectance: 0.95}";
  check("size: {length_mm: 20, width_mm: 10}, reflectors: {bottom: {reflectance: 0.9}, left: " + mirror +
            ", right: " + mirror + ", front: " + mirror + ", back: " + mirror +
            "}, sources: [{kind: lambertian_face, face: bottom}], films: [" + kDiffuser +
            ", {kind: lpp, gap_mm: 4, axis_deg: 30}]",
        300'000);
}
TEST(Estimators, PlateWithDots) {
  check(small_plate(), 150'000);
}
// Light of a dot goes up by way of both walls of a pair.
TEST(Estimators, PlateNarrowAgainstItsThickness) {
  check(
      "light_guide_plate: {length_mm: 2, width_mm: 20, thickness_mm: 4, refractive_index: 1.45}, microstructure: "
      "{cells: [1, 1], density: 0.3}, sources: [{kind: lambertian_face, face: front}]",
      2'000'000, "cells: [3, 4], cone_deg: 20, direction_deg: [60, 0]");
}
/// `auto` leaves lobes that are narrower than the cone to the wide film above, or to counting.
TEST(Estimators, NarrowLobeBelowAWideOne) {
  check(stack("{kind: diffuser, gap_mm: 1, haze: 0.9, fwhm_deg: 15}, " + kDiffuser + ", " + kLpp), 300'000,
        "cells: [8, 8], cone_deg: 30", "auto");
}
TEST(Estimators, NarrowLobeAboveAWideOne) {
  check(stack(kDiffuser + ", " + kLpp + ", {kind: diffuser, gap_mm: 1, haze: 0.9, fwhm_deg: 15}"), 300'000,
        "cells: [8, 8], cone_deg: 30", "auto");
}
TEST(Estimators, NarrowLobeOverLensesAndAWhiteSheet) {
  check(
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1}, microstructure: {cells: [8, 8], kind: "
      "microlens, density: 0.3}, sources: [{kind: led_row, count: 3}], reflectors: {bottom: {}, right: {}, front: {}, "
      "back: {}}, films: [{kind: diffuser, gap_mm: 0.5, haze: 0.9, fwhm_deg: 15}]",
      300'000, "cells: [8, 8], cone_deg: 30", "auto");
}
TEST(Estimators, NarrowCone) {
  check(stack(kDiffuser + ", " + table_dbef()), 400'000, "cells: [4, 4], cone_deg: 12");
}
/// Tilted directions of view; the film is polarized, so that the azimuth counts.
TEST(Estimators, TiltedCone) {
  check(stack(kDiffuser), 200'000, "cells: [4, 4], cone_deg: 20, direction_deg: [45, 30]");
}
/// A pupil so near that the direction of view varies by up to 45 degrees over the display; the film is polarized.
TEST(Estimators, PupilThroughLpp) {
  check(stack(kDiffuser + ", " + kLpp), 300'000,
        "cells: [4, 4], pupil: {distance_mm: 20, diameter_mm: 20, at: [14, 3]}");
}
/// Sheets between the scatterer and the pupil, so thick that the straight way to the pupil is not that of the light.
TEST(Estimators, PupilThroughThickSheets) {
  const std::string sheet = "{kind: sheet, gap_mm: 1, refractive_index: 1.7, thickness_mm: 3, absorption_per_m: 100}";
  check(stack(kDiffuser + ", " + sheet + ", " + sheet), 900'000,
        "cells: [2, 2], pupil: {distance_mm: 20, diameter_mm: 20, at: [-2, 3]}");
}
TEST(Estimators, PupilThroughTabulatedDbef) {
  check(stack(kDiffuser + ", " + table_dbef()), 300'000, "cells: [4, 4], pupil: {distance_mm: 25, diameter_mm: 25}");
}
TEST(Estimators, TiltedConeThroughTabulatedDbefAndLpp) {
  check(stack(kDiffuser + ", " + table_dbef() + ", " + kLpp), 300'000,
        "cells: [4, 4], cone_deg: 20, direction_deg: [50, 110]");
}
TEST(Estimators, TiltedConeUnderSheet) {
  check(stack(table_dbef() + ", {kind: sheet, gap_mm: 0.5, thickness_mm: 2}"), 300'000,
        "cells: [4, 4], cone_deg: 20, direction_deg: [60, 250]");
}

/// With 4608 cells the chi-square per cell is 1 within 0.021 (one sigma), so 0.08 means something: each of the runs has
/// about 90 photons a cell in the cone, enough for normal errors.
void check_many_cells(const std::string& films, const std::string& films_name) {
  const std::string backlight =
      "light_guide_plate: {length_mm: 140, width_mm: 66, thickness_mm: 0.6}, microstructure: {cells: [96, 48], "
      "density: 0.15}, "
      "sources: [{kind: led_row, count: 12, pitch_mm: 5.4}], reflectors: {bottom: {}, left: {reflectance: 0.7}, right: "
      "{}, front: {}, back: {}}, films: [" +
      films + "]";
  const std::string receiver = "cells: [96, 48], cone_deg: 15";
  const EstimatorComparison c =
      compare_estimators(backlight, receiver, receiver, {20'000'000, 303, 200, 0}, {20'000'000, 404, 200, 0});
  std::printf("%s: z %.2f, chi2/dof %.4f over %d cells, relative error of the mean's difference %.5f\n",
              films_name.c_str(), c.z_mean, c.chi2 / c.cells, c.cells, c.se_mean);
  EXPECT_LT(std::abs(c.z_mean), 3.0);
  EXPECT_NEAR(c.chi2 / c.cells, 1.0, 0.08);
}

TEST(EstimatorsLong, ManyCellsDiffuserAndDbef) {
  check_many_cells(
      "{kind: diffuser, transmittance: 0.88, reflectance: 0.1, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}, " +
          table_dbef(),
      "diffuser, dbef");
}
TEST(EstimatorsLong, ManyCellsDiffuserDbefLpp) {
  check_many_cells(
      "{kind: diffuser, transmittance: 0.88, reflectance: 0.1, haze: 0.95, fwhm_deg: 60, depolarization: 0.3}, " +
          table_dbef() + ", {kind: lpp, axis_deg: 30}",
      "diffuser, dbef, lpp");
}

}  // namespace
}  // namespace evenglow::tests
