#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tests/support/films.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

/// The energy account, the white furnace, the cavity multiplier and etendue. Seeds fixed; false alarm 1e-3 for each
/// test.
namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kPlate = "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}, ";
const std::string kDots = "microstructure: {cells: [8, 4], density: 0.2}, ";
const std::string kLeds = "sources: [{kind: led_row, count: 3, size_mm: [2, 0.4]}]";
const std::string kAllReflectors =
    "reflectors: {bottom: {}, left: {kind: mirror}, right: {}, front: {kind: mixed}, back: {}}, ";

std::string table_dbef(const std::string& more = "") {
  return "{kind: dbef, table: \"" + data_file("dbef.csv") + "\", hemispherical: \"" +
         data_file("dbef_hemispherical.csv") + "\"" + more + "}";
}

std::vector<std::string> many_backlights() {
  const std::string bare = "size: {length_mm: 20, width_mm: 10}, ";
  const std::string face = "sources: [{kind: lambertian_face, face: bottom}]";
  return {
      kPlate + kLeds,
      kPlate + kDots + kLeds,
      kPlate + kDots + kAllReflectors + kLeds,
      kPlate + kDots + kAllReflectors + "films: [{kind: diffuser}, " + table_dbef() + "], " + kLeds,
      kPlate + kDots + kAllReflectors + "films: [{kind: diffuser, haze: 0.5}, {kind: lpp}], " + kLeds,
      kPlate + kDots + kAllReflectors +
          "films: [{kind: diffuser, lobe: lambertian}, {kind: dbef, axis_deg: 30}, {kind: lpp, axis_deg: 30}], " +
          kLeds,
      kPlate + kDots + kAllReflectors +
          "films: [{kind: sheet}, {kind: diffuser}, {kind: sheet, thickness_mm: 2, absorption_per_m: 30}], " + kLeds,
      "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6, material: polycarbonate, absorption_per_m: "
      "20}, " +
          kDots +
          "reflectors: {top: {reflectance: 0.9}}, sources: [{kind: lambertian_face, face: left}, {kind: beam, face: "
          "top, gap_mm: 0.01, angle_deg: 50}]",
      bare + face,
      bare + "films: [" + table_dbef(", axis_deg: 45") + "], " + face,
      bare + "films: [{kind: diffuser, depolarization: 0.5}, " + table_dbef() +
          ", {kind: sheet, refractive_index: 1.6}, {kind: lpp}], reflectors: {bottom: {}}, " + face,
      bare +
          "films: [{kind: lpp}, {kind: sheet}], reflectors: {bottom: {kind: mirror}, left: {}}, sources: [{kind: beam, "
          "angle_deg: 80, polarization: circular}]",
      kPlate + "microstructure: {face: top, cells: [8, 4], density: 1}, " + kAllReflectors +
          "films: [{kind: diffuser}], " + kLeds,
  };
}

/// Every photon ends in one bin: the account is a count, so its sum is exact. Nothing is lost.
TEST(EnergyAccount, SumsToOneExactly) {
  for (const std::string& text : many_backlights()) {
    const Traced traced(text, {10'000, 1, 10, 1});
    EXPECT_EQ(traced.accounted(), traced.photons()) << text;
    EXPECT_EQ(traced.lost(), 0.0) << text;
    double shares = 0.0;
    for (const core::Estimate& e : traced.result().energy.totals()) shares += e.value / traced.photons();
    EXPECT_NEAR(shares, 1.0, 1e-9);
  }
}
TEST(EnergyAccountLong, SumsToOneExactly) {
  for (const std::string& text : many_backlights()) {
    const Traced traced(text, {1'000'000, 2, 100, 0});
    EXPECT_EQ(traced.accounted(), traced.photons()) << text;
    EXPECT_EQ(traced.lost(), 0.0) << text;
  }
}

/// All that stands in the way reflects or passes everything; all light leaves by the only opening, to the last photon.
TEST(WhiteFurnace, AllLightLeavesByTheTop) {
  const std::string white = "{kind: white, reflectance: 1}", mirror = "{kind: mirror, reflectance: 1}";
  const std::string walls = "reflectors: {bottom: " + white + ", left: " + white + ", right: " + mirror +
                            ", front: " + white + ", back: " + white + "}, ";
  const std::string plate =
      "light_guide_plate: {length_mm: 20, width_mm: 10, refractive_index: 1.5}, microstructure: {cells: [4, 2], "
      "density: 0.3, reflectance: 1}, ";
  const std::string leds = "sources: [{kind: led_row, count: 3, reflectance: 1}]";
  const std::string lossless = "{kind: diffuser, transmittance: 0.7, reflectance: 0.3}";
  for (const std::string& films :
       {std::string(), lossless, lossless + ", {kind: dbef, axis_deg: 30}", std::string("{kind: dbef}, {kind: sheet}"),
        "{kind: dbef, transmittance_pass: 0.8, reflectance_pass: 0.2, transmittance_block: 0.1, reflectance_block: "
        "0.9}, " +
            lossless}) {
    const Traced traced(plate + walls + "films: [" + films + "], " + leds, {10'000, 3, 10, 1});
    EXPECT_EQ(traced.escaped(Side::kTop), traced.photons()) << films;
  }
  // Without a plate, and by another opening.
  const Traced right(
      "size: {length_mm: 20, width_mm: 10}, films: [{kind: diffuser, gap_mm: 2, transmittance: 0.5, reflectance: "
      "0.5}], "
      "reflectors: {bottom: " +
          white + ", left: " + white + ", front: " + mirror + ", back: " + white + ", top: " + white +
          "}, sources: [{kind: lambertian_face, face: bottom}]",
      {10'000, 3, 10, 1});
  EXPECT_EQ(right.escaped(Side::kRight), right.photons());
}

/// Integrating cavity: walls of reflectance rho, a port of relative size f. Here the port is a film that passes f of
/// all light and returns the rest, over a bottom of rho between perfect mirrors; escaped: f / (1 - rho (1 - f)).
TEST(IntegratingCavity, Multiplier) {
  const double limit = z_limit(1e-3, 12);
  for (const double rho : {0.3, 0.8, 0.95}) {
    for (const double f : {0.1, 0.5}) {
      for (const std::string& kind : {std::string("white"), std::string("mirror")}) {
        const Traced traced(std::string(kMirrorRoom) + ", bottom: {kind: " + kind + ", reflectance: " + text_of(rho) +
                                "}}, films: [{kind: diffuser, depolarization: 1, transmittance: " + text_of(f) +
                                ", reflectance: " + text_of(1.0 - f) +
                                "}], sources: [{kind: lambertian_face, face: bottom}]",
                            {20'000, 4, 10, 1});
        EXPECT_LT(std::abs(binomial_z(traced.escaped(Side::kTop), traced.photons(), f / (1.0 - rho * (1.0 - f)))),
                  limit)
            << rho << " " << f;
        EXPECT_EQ(traced.escaped(Side::kTop) + traced.absorbed("reflectors.bottom"), traced.photons());
      }
    }
  }
}

std::string over_source(const std::string& films, const std::string& receiver) {
  return std::string(kMirrorRoom) + "}, films: [" + films +
         "], sources: [{kind: lambertian_face, face: bottom, flux_lm: 2e6}], "
         "receivers: [{kind: luminance, cells: [8, 4], " +
         receiver + "}]";
}

constexpr double kSourceLuminance = 1e6 / core::kPi;  // M / pi in cd/m2: 2e6 lm from 2e6 mm2

/// A Lambertian source seen by the receiver: L = M / pi, whatever the cone, by counting and by next-event estimate. A
/// lossless reciprocal diffuser that passes T of all light shows T times that from an even source.
TEST(Etendue, LambertianSourceHasItsLuminance) {
  const double limit = z_limit(1e-3, 7);
  for (const char* cone : {"10", "45", "90"}) {
    const Traced traced(over_source("", std::string("cone_deg: ") + cone), {200'000, 5, 100, 1});
    EXPECT_LT(std::abs(z_score(traced.mean_luminance(), kSourceLuminance)), limit) << cone;
  }
  struct Case {
    const char* diffuser;
    double transmittance;
    const char* estimator;
  };
  for (const Case& c :
       {Case{"transmittance: 1, reflectance: 0, lobe: lambertian", 1.0, "next_event"},
        {"transmittance: 0.7, reflectance: 0.3, lobe: lambertian, depolarization: 1", 0.7, "next_event"},
        {"transmittance: 0.7, reflectance: 0.3, fwhm_deg: 30, haze: 0.6", 0.7, "next_event"},
        {"transmittance: 0.7, reflectance: 0.3, fwhm_deg: 30, haze: 0.6", 0.7, "counting"}}) {
    const Traced traced(
        over_source(std::string("{kind: diffuser, ") + c.diffuser + "}", std::string("estimator: ") + c.estimator),
        {200'000, 6, 100, 1});
    const core::Estimate L = traced.mean_luminance();
    if (std::string(c.diffuser).find("lambertian") != std::string::npos) {
      EXPECT_NEAR(L.value / kSourceLuminance, c.transmittance, 3.0 * L.se / kSourceLuminance + 1e-5) << c.diffuser;
    } else {
      EXPECT_LT(std::abs(z_score(L, c.transmittance * kSourceLuminance)), limit) << c.diffuser << c.estimator;
    }
    EXPECT_LT(L.se / L.value, 0.02);
  }
}

/// No passive stack shows more than its source.
TEST(Etendue, NoStackIsBrighterThanTheSource) {
  for (const std::string& films :
       {std::string("{kind: dbef}"), std::string("{kind: sheet}, {kind: sheet}"), table_dbef(),
        "{kind: diffuser, transmittance: 1, reflectance: 0}, " + table_dbef(),
        "{kind: diffuser, transmittance: 0.9, reflectance: 0.1, fwhm_deg: 10}, {kind: sheet}, " + table_dbef() +
            ", {kind: lpp}",
        std::string("{kind: diffuser, fwhm_deg: 100, transmittance: 1, reflectance: 0}, {kind: diffuser, fwhm_deg: 5, "
                    "transmittance: 1, reflectance: 0}")}) {
    const Traced traced(over_source(films, "cone_deg: 10"), {100'000, 7, 100, 1});
    const core::Estimate L = traced.mean_luminance();
    EXPECT_LT(L.value, kSourceLuminance + 3.0 * L.se) << films;
    EXPECT_LT(L.se / kSourceLuminance, 0.03) << films;
  }
}

}  // namespace
}  // namespace evenglow::tests
