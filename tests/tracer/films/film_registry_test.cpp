#include "tracer/films/film_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

Film film_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("film: " + yaml, "run.yaml");
  auto film = film_registry().make(document.root().map("film", "a film", true));
  document.finish();
  return std::move(film.value());
}

std::string faults_of(const std::string& yaml) {
  try {
    film_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FilmRegistry, DefaultsOfEachKind) {
  for (const std::string kind : {"dbef", "lpp", "wire_grid", "retarder", "carrier", "diffuser"}) {
    const Film film = film_of("{kind: " + kind + "}");
    EXPECT_EQ(film.kind, kind);
    EXPECT_EQ(film.gap, 0.05);
    EXPECT_EQ(film.axis, 0.0);
    EXPECT_TRUE(film.surface);
    EXPECT_FALSE(film.sheet);
  }
}

TEST(FilmRegistry, Sheet) {
  const Film film = film_of("{kind: sheet, refractive_index: 1.58, absorption_per_m: 3, thickness_mm: 0.2, gap_mm: 1}");
  EXPECT_FALSE(film.surface);
  ASSERT_TRUE(film.sheet);
  EXPECT_EQ(film.sheet->refractive_index, 1.58);
  EXPECT_NEAR(film.sheet->absorption, 0.003, 1e-15);
  EXPECT_EQ(film.sheet->thickness, 0.2);
  EXPECT_EQ(film.gap, 1.0);
}

TEST(FilmRegistry, TabulatedDbef) {
  const Film film = film_of("{kind: dbef, axis_deg: 90, table: " + tests::data_file("dbef.csv") +
                            ", hemispherical: " + tests::data_file("dbef_hemispherical.csv") + "}");
  ASSERT_TRUE(film.surface);
  EXPECT_TRUE(film.surface->scatters());
  EXPECT_NEAR(film.axis, core::kPi / 2, 1e-12);
  ASSERT_EQ(film.remarks.size(), 3u);
  EXPECT_THAT(film.remarks[0], HasSubstr("dbef.csv: normalized to the hemispherical table"));
  EXPECT_EQ(film.remarks[1], "dbef.csv: no data beyond sigma = 60 degrees; the lobes of that incidence are held");
  EXPECT_EQ(film.remarks[2], "dbef.csv: data at 550 nm alone, used at every wavelength");
  EXPECT_FALSE(film.at_wavelength);
}

TEST(FilmRegistry, IdealDbefWithItsOwnPowers) {
  const Film film = film_of("{kind: dbef, transmittance_pass: 0.9, reflectance_pass: 0.05, transmittance_block: 0.02}");
  const auto specular = film.surface->specular(tests::travel(0, 0));
  EXPECT_NEAR(2.0 * specular.transmission(0, 0), 0.92, 1e-12);
  EXPECT_NEAR(2.0 * specular.reflection(0, 0), 0.05 + 0.98, 1e-12);
}

TEST(FilmRegistry, LppDependsOnTheAngleOnlyIfAsked) {
  const auto most = [](const std::string& keys) {
    const Film film = film_of("{kind: lpp, k1: 0.86" + keys + "}");
    const Eigen::RowVector4d row = film.surface->specular(tests::travel(70, 0)).transmission.row(0);
    return row[0] + row.tail<3>().norm();
  };
  EXPECT_NEAR(most(""), 0.86, 1e-12);
  EXPECT_NEAR(most(", angle_dependence: none"), 0.86, 1e-12);
  const double path = 1.0 / std::sqrt(1.0 - std::pow(std::sin(70 * tests::kRad) / 1.5, 2));
  EXPECT_NEAR(most(", angle_dependence: sheet"), 0.96 * std::pow(0.86 / 0.96, path), 1e-12);
  EXPECT_LT(most(", angle_dependence: sheet, refractive_index: 1.5"), 0.84);  // p light near its Brewster angle
}

TEST(FilmRegistry, LppFacesNameFaults) {
  EXPECT_THAT(faults_of("{kind: lpp, refractive_index: 1.5}"), HasSubstr("must stand beside angle_dependence: sheet"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.98, refractive_index: 1.5}"), HasSubstr("refractive_index"));
  EXPECT_THAT(faults_of("{kind: lpp, angle_dependence: sheet, refractive_index: 1.5, reflectance: 0.04}"),
              HasSubstr("reflectance: must not stand beside refractive_index"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.95, angle_dependence: sheet, refractive_index: 1.5}"),
              HasSubstr("k1: must be at most 0.923"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.98, angle_dependence: sheet}"), HasSubstr("reflectance: must be at most"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.2, k2: 0.5, angle_dependence: sheet}"), HasSubstr("k2: must be at most k1"));
}

TEST(FilmRegistry, NamesFaults) {
  EXPECT_THAT(faults_of("{kind: dbef, transmittance_pass: 0.9, reflectance_pass: 0.2}"),
              HasSubstr("reflectance_pass: must be at most"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.98}"), HasSubstr("reflectance: must be at most 1 - k1"));
  EXPECT_THAT(faults_of("{kind: lpp, k1: 0.2, k2: 0.5}"), HasSubstr("k2: must be at most k1"));
  EXPECT_THAT(faults_of("{kind: diffuser, transmittance: 0.9, reflectance: 0.3}"),
              HasSubstr("reflectance: must be at most"));
  EXPECT_THAT(faults_of("{kind: diffuser, lobe: lambertian, fwhm_deg: 20}"), HasSubstr("fwhm_deg"));
  EXPECT_THAT(faults_of("{kind: diffuser, axis_deg: 20}"), HasSubstr("axis_deg"));
  EXPECT_THAT(faults_of("{kind: lpp, axis_deg: 180}"), HasSubstr("[0, 180)"));
  EXPECT_THAT(faults_of("{kind: lpp, gap_mm: 0}"), HasSubstr("gap_mm"));
  EXPECT_THAT(faults_of("{kind: dbef, table: /no/such.csv}"), HasSubstr("table"));
  EXPECT_THAT(faults_of("{kind: dbef, table: " + tests::data_file("README.md") + "}"), HasSubstr("README.md"));
  EXPECT_THAT(faults_of("{kind: dbef, table: " + tests::data_file("dbef.csv") + ", transmittance_pass: 0.5}"),
              HasSubstr("transmittance_pass"));
  EXPECT_THAT(faults_of("{kind: foil}"), HasSubstr("kind"));
  EXPECT_THAT(faults_of("{kind: dbef, xyzzy: 1}"), HasSubstr("table, hemispherical, model, transmittance_pass"));
  EXPECT_THAT(faults_of("{kind: dbef, xyzzy: 1, table: " + tests::data_file("dbef.csv") + "}"),
              HasSubstr("known here: kind, gap_mm, axis_deg, table, wavelength_nm, hemispherical"));
}

}  // namespace
}  // namespace evenglow::tracer
