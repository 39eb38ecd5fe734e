#include <cmath>
#include <cstdio>
#include <ostream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/support/estimator_comparison.h"
#include "tests/support/films.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// The next-event estimate with paths from the viewer against plain counting, where light goes to and fro before it
/// reaches the viewer. Seeds fixed; false alarm 1e-3 over all scenes of this file.
namespace evenglow::tests {
namespace {

using namespace tracer;

/// A plate so small and thick that much light meets its walls, in a frame of white and mirrors.
std::string plate(const std::string& pattern, const std::string& films, const std::string& bottom = "{}",
                  const std::string& more = "") {
  return "light_guide_plate: {length_mm: 12, width_mm: 8, thickness_mm: 2" + more +
         "}, microstructure: {cells: [4, 4], density: 0.3, " + pattern +
         "}, sources: [{kind: led_row, count: 2, size_mm: [2, 1]}], reflectors: {bottom: " + bottom +
         ", left: {reflectance: 0.7}, right: {gap_mm: 0.3}, front: {kind: mirror}, back: {}}, films: [" + films + "]";
}

struct SceneCase {
  std::string name;
  std::string backlight;
  std::uint64_t photons;
  std::string receiver = "cells: [6, 4], cone_deg: 25";
  std::string counted = receiver;
  TracePath path = TracePath::kAuto;
};

const std::string kDots = "kind: printed_dot";
const std::string kLenses = "kind: microlens, form: sunk, aspect: 0.3";
const std::string kDiffuser =
    "{kind: diffuser, transmittance: 0.8, reflectance: 0.15, haze: 0.8, fwhm_deg: 60, depolarization: 0.3}";
const std::string kCrossed = "{kind: bef, axis_deg: 0}, {kind: bef, axis_deg: 90, gap_mm: 0.2}";

std::string table_dbef() {
  return "{kind: dbef, axis_deg: 30, table: \"" + data_file("dbef.csv") + "\", hemispherical: \"" +
         data_file("dbef_hemispherical.csv") + "\"}";
}

std::vector<SceneCase> scenes() {
  return {
      {"DotsUnderTheOpenSky", plate(kDots, ""), 100'000},
      {"DotsTraced", plate(kDots, kDiffuser), 60'000, "cells: [6, 4], cone_deg: 25", "cells: [6, 4], cone_deg: 25",
       TracePath::kGeneral},
      // The bottom mirrors half of its light, and the dots pass and mirror some.
      {"MixedBottomTranslucentDots",
       plate(kDots + ", reflectance: 0.7, transmittance: 0.2, specular_share: 0.2", kDiffuser, "{kind: mixed}"),
       60'000},
      {"DotsOnTop", plate(kDots + ", face: top", kDiffuser), 60'000},
      {"LensesOverAMirror", plate(kLenses, kDiffuser + ", " + kCrossed, "{kind: mirror}"), 40'000},
      {"LensesOverWhite", plate(kLenses, "{kind: lpp, axis_deg: 20, reflectance: 0.1}"), 150'000},
      {"CrossedPrismFilmsAndDbef", plate(kDots, kDiffuser + ", " + kCrossed + ", " + table_dbef()), 70'000},
      // What the sheet scatters in its bulk is counted, or estimated at the DBEF.
      {"VolumeScatteringSheet", plate(kDots, "{kind: sheet, thickness_mm: 0.5, scattering_per_mm: 2}, " + table_dbef()),
       60'000},
      {"Wedge", plate(kDots, kDiffuser, "{}", ", end_thickness_mm: 1.2"), 60'000},
      {"TiltedThroughPrismFilms", plate(kDots, kDiffuser + ", " + kCrossed), 300'000,
       "cells: [3, 2], cone_deg: 20, direction_deg: [40, 65]"},
      {"PupilOverPrismFilms", plate(kDots, kDiffuser + ", " + kCrossed), 40'000,
       "cells: [3, 2], pupil: {distance_mm: 30, diameter_mm: 25}"},
      // Under a Lambertian film the luminance is the same in all directions.
      {"OneDirection",
       plate(kDots,
             "{kind: diffuser, lobe: lambertian, depolarization: 1}, {kind: lpp, reflectance: 0, gap_mm: 0.001}"),
       100'000, "cells: [6, 4], cone_deg: 0, direction_deg: [30, 20]", "cells: [6, 4], cone_deg: 40"},
  };
}

void PrintTo(const SceneCase& scene, std::ostream* os) {
  *os << scene.name;
}

std::string name_of(const testing::TestParamInfo<SceneCase>& info) {
  return info.param.name;
}

void check(const SceneCase& scene, std::uint64_t factor, double largest_error) {
  const std::uint64_t photons = factor * scene.photons;
  const int threads = factor > 1 ? 0 : 1;
  const EstimatorComparison c =
      compare_estimators(scene.backlight, scene.receiver, scene.counted, {photons, 101, 100, threads, scene.path},
                         {photons, 202, 100, threads, scene.path});
  std::printf("z %.2f, chi2/dof %.3f, relative error of the difference %.4f\n", c.z_mean, c.chi2 / c.cells, c.se_mean);
  const std::size_t count = scenes().size();
  EXPECT_LT(std::abs(c.z_mean), z_limit(0.5e-3, count));
  EXPECT_GT(c.chance, sidak(0.25e-3, count)) << c.chi2 / c.cells;
  EXPECT_LT(c.chance, 1.0 - sidak(0.25e-3, count)) << c.chi2 / c.cells;
  EXPECT_LT(c.se_mean, largest_error);
}

class ViewerSubpathScenes : public testing::TestWithParam<SceneCase> {};
TEST_P(ViewerSubpathScenes, AgreeWithCounting) {
  check(GetParam(), 1, 0.02);
}
INSTANTIATE_TEST_SUITE_P(Small, ViewerSubpathScenes, testing::ValuesIn(scenes()), name_of);

/// The same to one in a thousand or two.
class ViewerSubpathScenesLong : public testing::TestWithParam<SceneCase> {};
TEST_P(ViewerSubpathScenesLong, AgreeWithCounting) {
  check(GetParam(), 100, 0.0025);
}
INSTANTIATE_TEST_SUITE_P(Small, ViewerSubpathScenesLong, testing::ValuesIn(scenes()), name_of);

}  // namespace
}  // namespace evenglow::tests
