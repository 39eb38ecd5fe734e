#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// A sheet that scatters in its bulk, as a user runs it.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

/// Lambertian light on an isotropic slab of two mean free paths between mirrors: T = 0.3900 (Heaslet and Warming,
/// 1965); 5 standard errors.
TEST(BulkScatteringCommand, Simulates) {
  const TempFolder folder;
  write_text(folder / "slab.yaml", R"(evenglow: 1
backlight:
  size: {length_mm: 200, width_mm: 100}
  sources: [{kind: lambertian_face, face: bottom}]
  reflectors:
    left: {kind: mirror, reflectance: 1}
    right: {kind: mirror, reflectance: 1}
    front: {kind: mirror, reflectance: 1}
    back: {kind: mirror, reflectance: 1}
  films: [{kind: sheet, refractive_index: 1.0001, thickness_mm: 0.1, scattering_per_mm: 20, anisotropy: 0}]
trace: {photons: 2e4, seed: 7, batches: 20}
)");
  const auto result = evenglow({"simulate", "slab.yaml", "-o", "out", "--quiet"}, folder.path());
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder / "out" / "result.json");
  const double top = json["energy"]["escaped"]["top"];
  EXPECT_NEAR(top, 0.3900, 5 * std::sqrt(0.39 * 0.61 / 2e4));
}

TEST(BulkScatteringCommand, IsSwept) {
  const TempFolder folder;
  write_text(folder / "film.yaml",
             "film: {kind: sheet, refractive_index: 1.0001, thickness_mm: 1, scattering_per_mm: 1, anisotropy: 0}\n");
  const auto result = evenglow({"film", "sweep", "film.yaml", "--sigma", "0", "--polarization", "none", "--photons",
                                "2e4", "--quiet", "-o", "out.csv"},
                               folder.path());
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("haze (ASTM D1003"));
  EXPECT_THAT(file_text(folder / "out.csv"), HasSubstr(",haze,haze_se,facets,facets_se\n"));
}

/// A goniometer integrates over a BSDF; that of a body's light there is none.
TEST(BulkScatteringCommand, TheGoniometerRefusesIt) {
  const TempFolder folder;
  write_text(folder / "g.yaml", "evenglow: 1\ngoniometer: {film: {kind: sheet, scattering_per_mm: 3}}\n");
  const auto result = evenglow({"film", "goniometer", "g.yaml"}, folder.path());
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err_lines(), ::testing::SizeIs(1)) << result.err;
  EXPECT_THAT(result.err, HasSubstr("must be a film, got a sheet with a body"));
}

}  // namespace
}  // namespace evenglow::tests
