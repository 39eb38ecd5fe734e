#include "tracer/films/retarder.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_yaml.h"
#include "tests/support/films.h"
#include "tests/support/specular_checks.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::film_faults;
using tests::film_from;
using tests::travel;

/// Retardance at normal incidence in [0, pi] from the matrix: cos = M33.
double phase_of(const Bsdf& film) {
  return std::acos(film.specular(travel(0, 0)).transmission(3, 3));
}

TEST(Retarder, DefaultIsAQuarterWaveAt550) {
  const Film film = film_from("{kind: retarder}");
  EXPECT_NEAR(phase_of(*film.surface), 0.5 * core::kPi, 1e-12);
  EXPECT_EQ(film.gap, 0.05);
  EXPECT_EQ(film.axis_index, 1.59);
}

TEST(Retarder, FastAxisFromXTowardsY) {
  const Film film = film_from("{kind: retarder, plate: half, axis_deg: 30}");
  EXPECT_NEAR(film.axis, 30 * tests::kRad, 1e-12);
  // A half wave turns light along x to twice the angle of its axis.
  const auto out =
      tests::passed(*film.surface, core::StokesVector::linear(1, 0, tangential_frame(travel(0, 0, true)).frame));
  EXPECT_NEAR(out.Q, std::cos(120 * tests::kRad), 1e-12);
  EXPECT_NEAR(out.U, std::sin(120 * tests::kRad), 1e-12);
}

TEST(Retarder, ThreeWaysToSayTheSame) {
  const double expected = 2 * core::kPi * 140 / 589;
  EXPECT_NEAR(phase_of(*film_from("{kind: retarder, retardance_nm: 140}").at_wavelength(589).surface), expected, 1e-12);
  EXPECT_NEAR(phase_of(*film_from("{kind: retarder, retardance_deg: 85.5687606, design_wavelength_nm: 589}")
                            .at_wavelength(589)
                            .surface),
              expected, 1e-8);
  EXPECT_NEAR(
      phase_of(*film_from("{kind: retarder, plate: half, design_wavelength_nm: 600}").at_wavelength(600).surface),
      core::kPi, 1e-6);
}

/// Without dispersion the phase goes as 1 / lambda; with it, the ratio of the retardances at 450 and 550 nm is that of
/// the key, and between lies Cauchy's form.
TEST(Retarder, Dispersion) {
  const Film plain = film_from("{kind: retarder, plate: quarter}");
  for (const double nm : {400.0, 450.0, 550.0, 700.0}) {
    EXPECT_NEAR(phase_of(*plain.at_wavelength(nm).surface), 0.5 * core::kPi * 550 / nm, 1e-9) << nm;
  }
  const Film film = film_from("{kind: retarder, retardance_nm: 100, dispersion_ratio: 1.08}");
  const auto nm_at = [&](double nm) { return phase_of(*film.at_wavelength(nm).surface) / (2 * core::kPi) * nm; };
  EXPECT_NEAR(nm_at(550), 100.0, 1e-9);
  EXPECT_NEAR(nm_at(450), 108.0, 1e-9);
  // R = a + b / lambda^2 through both.
  const double b = 8.0 / (1 / (450.0 * 450.0) - 1 / (550.0 * 550.0));
  EXPECT_NEAR(nm_at(650), 100.0 + b * (1 / (650.0 * 650.0) - 1 / (550.0 * 550.0)), 1e-9);
  for (const double ratio : {0.8, 1.3}) {
    for (double nm = 300; nm <= 2000; nm += 50) EXPECT_GT((RetardanceDispersion{300, ratio}.factor(nm)), 0.0);
  }
}

TEST(Retarder, FacesReflect) {
  const auto coated = film_from("{kind: retarder}").surface->specular(travel(0, 0));
  EXPECT_EQ(coated.reflection(0, 0), 0.0);
  const auto bare =
      film_from("{kind: retarder, faces: fresnel, refractive_index: 1.5}").surface->specular(travel(0, 0));
  EXPECT_NEAR(bare.reflection(0, 0), 0.08 / 1.04, 1e-12);
}

TEST(Retarder, NamesFaults) {
  EXPECT_THAT(film_faults("{kind: retarder, plate: third}"), HasSubstr("plate"));
  EXPECT_THAT(film_faults("{kind: retarder, plate: half, retardance_nm: 100}"),
              HasSubstr("retardance_nm: must not stand beside plate"));
  EXPECT_THAT(film_faults("{kind: retarder, retardance_deg: 90, retardance_nm: 100}"),
              HasSubstr("retardance_deg: must not stand beside retardance_nm"));
  EXPECT_THAT(film_faults("{kind: retarder, retardance_nm: -1}"), HasSubstr("retardance_nm"));
  EXPECT_THAT(film_faults("{kind: retarder, dispersion_ratio: 2}"), HasSubstr("[0.8, 1.3]"));
  EXPECT_THAT(film_faults("{kind: retarder, refractive_index: 1.1, birefringence: -0.2}"),
              HasSubstr("birefringence: must be at least"));
  EXPECT_THAT(film_faults("{kind: retarder, axis_deg: 200}"), HasSubstr("[0, 180)"));
  EXPECT_THAT(film_faults("{kind: retarder, thickness_mm: 1}"), HasSubstr("thickness_mm"));
}

}  // namespace
}  // namespace evenglow::tracer
