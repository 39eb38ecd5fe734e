#include "tracer/films/bef_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/units.h"
#include "tracer/films/bef.h"
#include "tracer/films/film_registry.h"
#include "tracer/optics/material.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

Film film_of(const std::string& keys) {
  const auto document = core::ConfigDocument::parse("film: {kind: bef" + keys + "}", "run.yaml");
  auto film = film_registry().make(document.root().map("film", "a film", true));
  document.finish();
  return std::move(film.value());
}

PrismFilmSpec spec_of(const std::string& keys) {
  return dynamic_cast<const PrismFilm&>(*film_of(keys).surface).spec();
}

std::string faults_of(const std::string& keys) {
  try {
    film_of(keys);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(BefMaker, Defaults) {
  const Film film = film_of("");
  EXPECT_EQ(film.kind, "bef");
  EXPECT_EQ(film.gap, 0.05);
  EXPECT_EQ(film.axis, 0.0);
  EXPECT_FALSE(film.sheet);
  EXPECT_FALSE(film.at_wavelength);
  const PrismFilmSpec spec = spec_of("");
  EXPECT_NEAR(spec.profile.apex, core::kPi / 2, 1e-12);
  EXPECT_NEAR(spec.profile.pitch, 0.05, 1e-15);
  EXPECT_NEAR(spec.base, 0.125, 1e-15);
  EXPECT_EQ(spec.profile.tip_flat, 0.0);
  EXPECT_EQ(spec.profile.tip_radius, 0.0);
  EXPECT_EQ(spec.refractive_index, 1.58);
  EXPECT_EQ(spec.absorption, 0.0);
  EXPECT_FALSE(spec.inverted);
}

TEST(BefMaker, EveryKey) {
  const std::string keys =
      ", apex_deg: 64, pitch_um: 24, base_um: 62, tip_flat_um: 2, refractive_index: 1.6, absorption_per_m: 5, "
      "axis_deg: "
      "90, inverted: true, gap_mm: 0.1";
  EXPECT_EQ(film_of(keys).gap, 0.1);
  EXPECT_NEAR(film_of(keys).axis, core::kPi / 2, 1e-12);
  const PrismFilmSpec spec = spec_of(keys);
  EXPECT_NEAR(spec.profile.apex, 64 * core::kRadPerDeg, 1e-12);
  EXPECT_NEAR(spec.profile.pitch, 0.024, 1e-15);
  EXPECT_NEAR(spec.base, 0.062, 1e-15);
  EXPECT_NEAR(spec.profile.tip_flat, 0.002, 1e-15);
  EXPECT_EQ(spec.refractive_index, 1.6);
  EXPECT_NEAR(spec.absorption, 0.005, 1e-15);
  EXPECT_NEAR(spec.axis, core::kPi / 2, 1e-12);
  EXPECT_TRUE(spec.inverted);
  EXPECT_NEAR(spec_of(", tip_radius_um: 8").profile.tip_radius, 0.008, 1e-15);
}

TEST(BefMaker, AMaterialHasDispersionAndLoss) {
  const Film film = film_of(", material: polycarbonate");
  const auto& surface = dynamic_cast<const PrismFilm&>(*film.surface);
  const Material green = material("polycarbonate", 550.0);
  EXPECT_EQ(surface.spec().refractive_index, green.refractive_index);
  EXPECT_NEAR(surface.spec().absorption, green.absorption, 1e-12);
  ASSERT_TRUE(film.at_wavelength);
  const FilmOptics blue = film.at_wavelength(450.0);
  EXPECT_FALSE(blue.sheet);
  const auto& there = dynamic_cast<const PrismFilm&>(*blue.surface).spec();
  EXPECT_NEAR(there.refractive_index, 1.6078, 1e-4);  // Sultanova et al. 2009
  EXPECT_EQ(there.profile.pitch, surface.spec().profile.pitch);
  EXPECT_NEAR(spec_of(", material: polycarbonate, absorption_per_m: 2").absorption, 0.002, 1e-15);
}

TEST(BefMaker, Faults) {
  EXPECT_THAT(faults_of(", apex_deg: 180"), HasSubstr("apex_deg"));
  EXPECT_THAT(faults_of(", pitch_um: 0"), HasSubstr("pitch_um"));
  EXPECT_THAT(faults_of(", tip_flat_um: 50"), HasSubstr("at most 49.5 for this pitch, got 50"));
  EXPECT_THAT(faults_of(", tip_radius_um: 40"), HasSubstr("at most 35.0018 for this pitch and apex, got 40"));
  EXPECT_THAT(faults_of(", tip_radius_um: 1, tip_flat_um: 1"), HasSubstr("must be left out where tip_flat_um"));
  EXPECT_THAT(faults_of(", material: glass"), HasSubstr("material"));
  EXPECT_THAT(faults_of(", material: pmma, refractive_index: 1.5"),
              HasSubstr("must be left out where refractive_index"));
  EXPECT_THAT(faults_of(", axis_deg: 180"), HasSubstr("axis_deg"));
  EXPECT_THAT(faults_of(", inverted: maybe"), HasSubstr("inverted"));
  EXPECT_THAT(faults_of(", tip_um: 3"), HasSubstr("tip_um"));
}

}  // namespace
}  // namespace evenglow::tracer
