#include "tracer/goniometer/film_sweep.h"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/support/film_yaml.h"
#include "tests/support/films.h"
#include "tests/support/z_test.h"
#include "tracer/optics/dielectric_face.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {
namespace {

using tests::film_from;
using tests::kRad;

const std::vector<SweepLight> kAllLights{SweepLight::natural,  SweepLight::pass,  SweepLight::block,
                                         SweepLight::diagonal, SweepLight::right, SweepLight::left};

std::vector<SweepRow> sweep(const std::string& film, SweepSpec spec) {
  if (spec.sigmas.empty()) spec.sigmas = {0.0};
  auto rows = sweep_film(film_from(film), spec);
  EXPECT_TRUE(rows.has_value());
  return *rows;
}

TEST(FilmSweep, RowsInOrder) {
  SweepSpec spec;
  spec.wavelengths = {450, 550};
  spec.azimuths = {0.0, 1.0};
  spec.sigmas = {0.1, 0.2, 0.3};
  spec.lights = {SweepLight::pass, SweepLight::block};
  const auto rows = sweep("{kind: lpp}", spec);
  ASSERT_EQ(rows.size(), 24u);
  EXPECT_EQ(rows[1].sigma, 0.2);
  EXPECT_EQ(rows[3].light, SweepLight::block);
  EXPECT_EQ(rows[6].azimuth, 1.0);
  EXPECT_EQ(rows[12].wavelength, 550);
}

/// A polarizer reads its own numbers at every angle, azimuth and from both sides: `pass` is what its rays see.
TEST(FilmSweep, PolarizersReadTheirNumbers) {
  SweepSpec spec;
  spec.azimuths = {0.0, 0.6, 4.0};
  spec.sigmas = {0.0, 0.5, 1.4};
  spec.lights = kAllLights;
  for (const bool above : {false, true}) {
    spec.from_above = above;
    for (const std::string film :
         {"{kind: lpp, axis_deg: 35, k1: 0.9, k2: 0.1}",
          "{kind: dbef, axis_deg: 35, transmittance_pass: 0.9, transmittance_block: 0.1, reflectance_block: 0.7}"}) {
      for (const SweepRow& row : sweep(film, spec)) {
        const double expected = row.light == SweepLight::pass ? 0.9 : row.light == SweepLight::block ? 0.1 : 0.5;
        EXPECT_NEAR(row.transmittance.value, expected, 1e-12);
        EXPECT_EQ(row.transmittance.se, 0.0);
        EXPECT_EQ(row.specular_transmittance.value, row.transmittance.value);
        EXPECT_NEAR(row.reflectance.value + row.transmittance.value + row.absorbed.value, 1.0, 1e-12);
        ASSERT_TRUE(row.transmitted);
        EXPECT_NEAR(row.transmitted->degree, row.light == SweepLight::natural ? 0.8 : 1.0, 1e-12);
      }
    }
  }
}

/// A quarter wave: light at 45 degrees from the fast axis, counted towards z x h, comes out left circular where it
/// travels up, right where it travels down (wave_plate_test.cpp); circular light comes out linear at +-45 degrees.
TEST(FilmSweep, StatesAreRightHanded) {
  SweepSpec spec;
  spec.lights = kAllLights;
  for (const bool above : {false, true}) {
    spec.from_above = above;
    const auto rows = sweep("{kind: retarder}", spec);
    EXPECT_NEAR(rows[3].transmitted->v, above ? 1.0 : -1.0, 1e-12);
    EXPECT_NEAR(rows[4].transmitted->u, 1.0, 1e-12);  // V = 1: U + iV = i -> i exp(-i pi/2) = 1
    EXPECT_NEAR(rows[5].transmitted->u, -1.0, 1e-12);
    EXPECT_NEAR(rows[1].transmitted->q, 1.0, 1e-12);
  }
}

TEST(FilmSweep, FollowsTheWavelength) {
  SweepSpec spec;
  spec.wavelengths = {550, 1100};
  spec.lights = {SweepLight::diagonal};
  const auto rows = sweep("{kind: retarder, plate: half}", spec);
  EXPECT_NEAR(rows[0].transmitted->u, -1.0, 1e-12);
  EXPECT_NEAR(rows[1].transmitted->v, -1.0, 1e-12);
}

TEST(FilmSweep, SheetsWithABodyAreExact) {
  SweepSpec spec;
  spec.sigmas = {60 * kRad};
  const auto row = sweep("{kind: sheet, refractive_index: 1.6, absorption_per_m: 200, thickness_mm: 1}", spec).front();
  const auto sheet = incoherent_sheet(0.5, 1.6, 0.2, 1.0);
  EXPECT_NEAR(row.transmittance.value, sheet.transmission(0, 0), 1e-12);
  EXPECT_NEAR(row.reflectance.value, sheet.reflection(0, 0), 1e-12);
  EXPECT_GT(row.absorbed.value, 0.1);
}

/// Counted shares of a diffuser against its definition; false alarm 1e-3 over all comparisons.
TEST(FilmSweep, CountsScatteredLight) {
  SweepSpec spec;
  spec.sigmas = {0.0, 1.0};
  spec.lights = {SweepLight::natural, SweepLight::right};
  spec.photons = 20'000;
  spec.threads = 2;
  const auto rows = sweep("{kind: diffuser, transmittance: 0.7, reflectance: 0.2, haze: 0.6}", spec);
  const double limit = tests::z_limit(1e-3, rows.size() * 5);
  for (const SweepRow& row : rows) {
    for (const auto& [share, expected] : {std::pair{row.transmittance, 0.7},
                                          {row.reflectance, 0.2},
                                          {row.specular_transmittance, 0.28},
                                          {row.scattered_transmittance, 0.42},
                                          {row.absorbed, 0.1}}) {
      EXPECT_LT(std::abs(tests::z_score(share, expected)), limit) << share.value << " for " << expected;
      EXPECT_NEAR(share.se, std::sqrt(expected * (1 - expected) / 20'000), 2e-4);
    }
    EXPECT_EQ(row.specular_reflectance.value, 0.0);
    EXPECT_NEAR(row.transmittance.value + row.reflectance.value + row.absorbed.value, 1.0, 1e-12);
    EXPECT_NEAR(row.transmitted->degree, row.light == SweepLight::natural ? 0.0 : 1.0, 1e-12);
  }
}

/// A slab that scatters isotropically, without faces: straight light by Beer and Lambert, T of Lambertian light is
/// known (scattering_sheet_test.cpp); here the bounds of a beam. False alarm 1e-3 over all comparisons.
TEST(FilmSweep, TracesSheetsThatScatter) {
  SweepSpec spec;
  spec.sigmas = {0.0, 1.0};
  spec.lights = {SweepLight::natural, SweepLight::pass};
  spec.photons = 20'000;
  const std::string film =
      "{kind: sheet, refractive_index: 1.0001, thickness_mm: 0.5, scattering_per_mm: 3, anisotropy: 0.5}";
  EXPECT_TRUE(needs_photons(film_from(film)));
  EXPECT_FALSE(needs_photons(film_from("{kind: sheet}")));
  const auto rows = sweep(film, spec);
  const double limit = tests::z_limit(1e-3, rows.size());
  for (const SweepRow& row : rows) {
    const double straight = std::exp(-1.5 / std::cos(row.sigma));
    EXPECT_LT(std::abs(tests::z_score(row.specular_transmittance, straight)), limit);
    EXPECT_EQ(row.absorbed.value, 0.0);
    EXPECT_GT(row.scattered_transmittance.value, 0.0);
    EXPECT_GT(row.scattered_reflectance.value, 0.0);
    ASSERT_TRUE(row.transmitted);
    EXPECT_NEAR(row.transmitted->degree, row.light == SweepLight::natural ? 0.0 : 1.0, 1e-3);
  }
}

TEST(FilmSweep, ScatteringSheetsFollowTheWavelength) {
  SweepSpec spec;
  spec.wavelengths = {450, 650};
  spec.photons = 1'000;
  const auto rows = sweep("{kind: sheet, material: polycarbonate, scattering_per_mm: 0.001}", spec);
  for (const SweepRow& row : rows) {
    const double n = material("polycarbonate", row.wavelength).refractive_index;
    const double R = incoherent_sheet(1.0, n, 0.0, 0.1).reflection(0, 0);
    EXPECT_LT(std::abs(tests::z_score(row.reflectance, R)), 4.0);
  }
  // And a clear one exactly.
  const auto clear = sweep("{kind: sheet, material: polycarbonate, absorption_per_m: 0}", spec);
  EXPECT_GT(clear[0].reflectance.value, clear[1].reflectance.value + 1e-3);
}

/// Haze of films where it is known; false alarm 1e-3 over all comparisons.
TEST(FilmSweep, Haze) {
  SweepSpec spec;
  spec.sigmas = {0.0, 0.5};
  spec.photons = 20'000;
  const double inside = std::pow(std::sin(2.5 * kRad), 2);
  const double limit = tests::z_limit(1e-3, 4);
  for (const auto& [film, expected] :
       {std::pair<std::string, double>{"{kind: diffuser, haze_astm: 0.3}", 0.3},
        {"{kind: diffuser, haze: 0.6, haze_astm: 0.3, transmittance: 0.5}", 0.3},
        {"{kind: diffuser, lobe: lambertian}", 1.0 - inside},
        {"{kind: diffuser, lobe: lambertian, haze: 0.7, transmittance: 0.4}", 0.7 * (1.0 - inside)}}) {
    const auto rows = sweep(film, spec);
    ASSERT_TRUE(rows[0].haze) << film;
    const double z = (rows[0].haze->value - expected) /
                     std::sqrt(expected * (1.0 - expected) / (rows[0].transmittance.value * 20'000));
    EXPECT_LT(std::abs(z), limit) << film << ": " << rows[0].haze->value;
    EXPECT_FALSE(rows[1].haze);
  }
  EXPECT_EQ(sweep("{kind: lpp}", spec)[0].haze->value, 0.0);
  EXPECT_EQ(sweep("{kind: sheet}", spec)[0].haze->value, 0.0);
  EXPECT_FALSE(sweep("{kind: diffuser, transmittance: 0, reflectance: 1}", spec)[0].haze);
}

TEST(FilmSweep, DependsOnTheSeedAndNotOnThreads) {
  SweepSpec spec;
  spec.sigmas = {0.0, 0.5, 1.0};
  spec.photons = 1'000;
  const auto values = [&](std::uint64_t seed, int threads) {
    spec.seed = seed;
    spec.threads = threads;
    std::vector<double> all;
    for (const SweepRow& row : sweep("{kind: diffuser}", spec)) all.push_back(row.transmittance.value);
    return all;
  };
  EXPECT_EQ(values(1, 1), values(1, 3));
  EXPECT_NE(values(1, 1), values(2, 1));
}

TEST(FilmSweep, Stops) {
  std::stop_source source;
  source.request_stop();
  SweepSpec spec;
  spec.sigmas = {0.0};
  spec.stop = source.get_token();
  EXPECT_FALSE(sweep_film(film_from("{kind: diffuser}"), spec).has_value());
}

}  // namespace
}  // namespace evenglow::tracer
