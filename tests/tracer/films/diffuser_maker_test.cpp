#include "tracer/films/diffuser_maker.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/film_yaml.h"
#include "tests/support/films.h"
#include "tests/support/temp_folder.h"
#include "tracer/films/haze.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;
using tests::film_faults;
using tests::film_from;
using tests::kRad;
using tests::travel;

/// Luminance at theta degrees over that at 0, normal incidence.
double relative(const Film& film, double theta) {
  const auto light = core::StokesVector::unpolarized(1.0, tangential_frame(travel(0, 0)).frame);
  return film.surface->evaluate(light, travel(theta, 0)).I / film.surface->evaluate(light, travel(0, 0)).I;
}

TEST(DiffuserMaker, GaussianByItsWidthOrItsHaze) {
  EXPECT_NEAR(relative(film_from("{kind: diffuser}"), 20), 0.5, 0.01);  // but for the scaling c
  EXPECT_NEAR(relative(film_from("{kind: diffuser, fwhm_deg: 10}"), 5), 0.5, 1e-3);
  // Half of 0.8 scattered: 40 % of all.
  const Film film = film_from("{kind: diffuser, haze: 0.8, haze_astm: 0.4}");
  const double s = std::sin(2.5 * kRad) / std::sqrt(2.0 * std::log(2.0));
  EXPECT_NEAR(relative(film, 4), std::exp(-0.5 * std::pow(std::sin(4 * kRad) / s, 2)), 1e-4);
}

TEST(DiffuserMaker, Abg) {
  const Film film = film_from("{kind: diffuser, lobe: abg, abg_b: 1e-3, abg_g: 2}");
  const double d = std::sin(3 * kRad);
  EXPECT_NEAR(relative(film, 3), 1e-3 / (1e-3 + d * d), 0.01);
  EXPECT_TRUE(film.surface->scatters());
}

TEST(DiffuserMaker, Lambertian) {
  EXPECT_NEAR(relative(film_from("{kind: diffuser, lobe: lambertian}"), 70), 1.0, 1e-12);
}

TEST(DiffuserMaker, Tabulated) {
  const tests::TempFolder folder;
  const std::string path = (folder / "t.csv").string();
  tests::write_text(folder / "t.csv", "incidence_deg,theta_deg,btdf\n0,0,1\n0,10,0.6\n0,20,0.3\n0,40,0.1\n0,60,0.05\n");
  const auto keys = [&](const std::string& more) {
    return "{kind: diffuser, lobe: tabulated, table: " + path + more + "}";
  };
  EXPECT_NEAR(relative(film_from(keys("")), 20), 0.3, 0.01);
  EXPECT_EQ(film_faults(keys(", transmittance: 0.7, reflectance: 0")), "accepted");
  EXPECT_THAT(film_from(keys(", transmittance: 0.7, reflectance: 0")).remarks,
              ::testing::SizeIs(2));  // the other: where the data end
  EXPECT_THAT(film_faults(keys(", transmittance: 0.7")), HasSubstr("must stand beside reflectance"));
  EXPECT_THAT(film_faults(keys(", transmittance: 0.7, reflectance: 0.1")), HasSubstr("a table without brdf"));
  EXPECT_THAT(film_faults(keys(", fwhm_deg: 10")), HasSubstr("fwhm_deg"));
  EXPECT_THAT(film_faults(keys(", haze: 0.5")), HasSubstr("haze"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: tabulated}"), HasSubstr("table: must be given"));
}

TEST(DiffuserMaker, RefusesInOneLine) {
  EXPECT_THAT(film_faults("{kind: diffuser, haze_astm: 0.5, fwhm_deg: 10}"), HasSubstr("got both"));
  EXPECT_THAT(film_faults("{kind: diffuser, haze_astm: 0.5, haze: 0.4}"), HasSubstr("haze_astm: must be at most"));
  EXPECT_THAT(film_faults("{kind: diffuser, haze_astm: 1}"), HasSubstr("haze_astm: must"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: lambertian, haze_astm: 0.5}"), HasSubstr("haze_astm"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: abg}"), HasSubstr("abg_g: must be given"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: abg, abg_b: 1e-9, abg_g: 2}"), HasSubstr("[0.001, 2], got 3.16"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: abg, abg_b: 0, abg_g: 2}"), HasSubstr("abg_b: must"));
  EXPECT_THAT(film_faults("{kind: diffuser, lobe: abg, abg_b: 1e-3, abg_g: 9}"), HasSubstr("abg_g: must lie in"));
  EXPECT_THAT(film_faults("{kind: diffuser, abg_g: 2}"), HasSubstr("abg_g"));
}

}  // namespace
}  // namespace evenglow::tracer
