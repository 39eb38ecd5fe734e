#include "tracer/films/sheet.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_yaml.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;
using tests::film_faults;
using tests::film_from;

TEST(Sheet, IsClearUnlessAskedToScatter) {
  const Film film = film_from("{kind: sheet}");
  ASSERT_TRUE(film.sheet);
  EXPECT_EQ(film.sheet->refractive_index, 1.5);
  EXPECT_EQ(film.sheet->absorption, 0.0);
  EXPECT_EQ(film.sheet->thickness, 0.1);
  EXPECT_FALSE(film.sheet->scattering);
  EXPECT_FALSE(film.at_wavelength);
  EXPECT_FALSE(film_from("{kind: sheet, scattering_per_mm: 0}").sheet->scattering);
}

TEST(Sheet, ScattersInItsBulk) {
  const Film film = film_from(
      "{kind: sheet, thickness_mm: 2, absorption_per_m: 5, scattering_per_mm: 12.5, anisotropy: 0.7, depolarization: "
      "0.2}");
  ASSERT_TRUE(film.sheet && film.sheet->scattering);
  EXPECT_DOUBLE_EQ(film.sheet->absorption, 0.005);
  EXPECT_DOUBLE_EQ(film.sheet->scattering->coefficient, 12.5);
  EXPECT_DOUBLE_EQ(film.sheet->scattering->anisotropy, 0.7);
  EXPECT_DOUBLE_EQ(film.sheet->scattering->depolarization, 0.2);
  const Film other = film_from("{kind: sheet, scattering_per_mm: 1}");
  EXPECT_DOUBLE_EQ(other.sheet->scattering->anisotropy, 0.9);
  EXPECT_DOUBLE_EQ(other.sheet->scattering->depolarization, 1.0);
}

TEST(Sheet, MaterialsFollowTheWavelength) {
  const Film film = film_from("{kind: sheet, material: polycarbonate, scattering_per_mm: 3}");
  EXPECT_DOUBLE_EQ(film.sheet->refractive_index, material("polycarbonate", 550).refractive_index);
  EXPECT_DOUBLE_EQ(film.sheet->absorption, 0.3e-3);
  ASSERT_TRUE(film.at_wavelength);
  const FilmOptics blue = film.at_wavelength(450);
  EXPECT_EQ(blue.surface, nullptr);
  EXPECT_DOUBLE_EQ(blue.sheet->refractive_index, material("polycarbonate", 450).refractive_index);
  EXPECT_DOUBLE_EQ(blue.sheet->scattering->coefficient, 3.0);
  EXPECT_EQ(film_from("{kind: sheet, material: pmma, absorption_per_m: 0}").sheet->absorption, 0.0);
}

TEST(Sheet, RefusesInOneLine) {
  EXPECT_THAT(film_faults("{kind: sheet, scattering_per_mm: -1}"), HasSubstr("scattering_per_mm: must lie in"));
  EXPECT_THAT(film_faults("{kind: sheet, scattering_per_mm: 200, thickness_mm: 50}"),
              HasSubstr("must be at most 20 for this thickness"));
  EXPECT_THAT(film_faults("{kind: sheet, scattering_per_mm: 2, anisotropy: 1}"), HasSubstr("anisotropy: must lie in"));
  EXPECT_THAT(film_faults("{kind: sheet, anisotropy: 0.5}"), HasSubstr("must stand beside scattering_per_mm"));
  EXPECT_THAT(film_faults("{kind: sheet, depolarization: 0.5}"), HasSubstr("must stand beside scattering_per_mm"));
  EXPECT_THAT(film_faults("{kind: sheet, material: glass}"), HasSubstr("material: must be one of"));
  EXPECT_THAT(film_faults("{kind: sheet, material: pmma, refractive_index: 1.5}"), HasSubstr("got both"));
}

}  // namespace
}  // namespace evenglow::tracer
