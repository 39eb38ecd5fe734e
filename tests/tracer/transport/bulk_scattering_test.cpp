#include <cmath>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// Sheets that scatter in their bulk, in whole backlights. Chance of a false alarm 1e-4 for each test. Seeds fixed.
namespace evenglow::tests {
namespace {

using tracer::Side;

/// Films in a room of mirrors that is lit through its open bottom.
std::string room(const std::string& source, const std::string& films) {
  return std::string(kMirrorRoom) + "}, sources: [" + source + "], films: [" + films + "]";
}

const char* const kLambertian = "{kind: lambertian_face, face: bottom}";
const char* const kNarrow = "{kind: beam, face: bottom}";

/// Transmittances of isotropic slabs for Lambertian light from the integral equation of transport, which
/// scattering_sheet_test.cpp solves and checks against Heaslet and Warming's table.
TEST(BulkScattering, IsotropicSheetsInARoom) {
  const TraceSetup setup{40'000, 3, 100, 1};
  for (const auto& [depth, expected] : {std::pair{1.0, 0.5532}, {2.0, 0.3900}, {5.0, 0.2077}}) {
    const Traced traced(room(kLambertian, fmt::format("{{kind: sheet, refractive_index: 1.0001, thickness_mm: 2, "
                                                      "scattering_per_mm: {}, anisotropy: 0}}",
                                                      depth / 2.0)),
                        setup);
    EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kTop), traced.photons(), expected)), z_limit(1e-4, 3)) << depth;
    EXPECT_EQ(traced.escaped(Side::kTop) + traced.escaped(Side::kBottom), traced.photons());
    EXPECT_EQ(traced.lost(), 0.0);
  }
}

/// Two sheets of one index with a hair of air are not one sheet (faces), but without faces they are.
TEST(BulkScattering, SheetsWithoutFacesAddUp) {
  const TraceSetup setup{40'000, 4, 100, 1};
  const std::string half =
      "{kind: sheet, refractive_index: 1.0001, thickness_mm: 0.5, scattering_per_mm: 2, anisotropy: 0}";
  const Traced traced(room(kLambertian, half + ", " + half), setup);
  EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kTop), traced.photons(), 0.3900)), z_limit(1e-4, 1));
}

/// Absorption in the bulk goes by the whole way of a photon: white absorption and scattering of one slab account for
/// all light, and what is absorbed is booked on the sheet.
TEST(BulkScattering, AbsorptionIsBookedOnTheSheet) {
  const Traced traced(
      room(kNarrow, "{kind: sheet, thickness_mm: 1, scattering_per_mm: 5, anisotropy: 0.5, absorption_per_m: 200}"),
      {20'000, 5, 100, 1});
  const double absorbed = traced.absorbed("films[0]");
  EXPECT_EQ(absorbed + traced.escaped(Side::kTop) + traced.escaped(Side::kBottom), traced.photons());
  // More than one straight passage takes, as scattered ways are longer.
  EXPECT_GT(absorbed / traced.photons(), 1.0 - std::exp(-0.2));
}

/// A sheet above a diffuser shuts out the next-event estimate; the luminance is counted.
TEST(BulkScattering, LuminanceIsCounted) {
  const Traced traced(room(kLambertian,
                           "{kind: diffuser, lobe: lambertian, transmittance: 1, reflectance: 0}, {kind: sheet, "
                           "refractive_index: 1.0001, scattering_per_mm: 30, anisotropy: 0}"),
                      {50'000, 6, 100, 1});
  const auto luminance = traced.mean_luminance();
  EXPECT_GT(luminance.value, 0.0);
  EXPECT_GT(luminance.se, 0.0);
  EXPECT_LT(luminance.se, 0.2 * luminance.value);
}

}  // namespace
}  // namespace evenglow::tests
