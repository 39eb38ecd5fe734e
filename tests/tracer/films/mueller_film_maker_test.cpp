#include "tracer/films/mueller_film_maker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"
#include "tests/support/temp_folder.h"
#include "tracer/films/film_registry.h"
#include "tracer/films/mueller_film.h"

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

/// Transmits the share (nm - 400) / 1000 of any light, in all directions alike, and turns linear polarization.
StoredTable spectral(const std::vector<double>& wavelengths) {
  return tests::mueller_stored("m.csv", {1},
                               {{{0, 90}, {0, 60}, {0, 60, 120, 180, 240, 300}, {0, 45, 90}, wavelengths}},
                               [&](const tests::NodeIndex& i) -> core::MuellerMatrix {
                                 return (wavelengths[i[5]] - 400.0) / 1000.0 / core::kPi * core::rotator(0.3);
                               });
}

class MuellerFilmMaker : public testing::Test {
 protected:
  MuellerFilmMaker() {
    tests::write_text(folder_ / "m.csv", csv_text(spectral({450, 650})));
    tests::write_text(folder_ / "m.h5", stored_bytes(spectral({450, 650}), true));
    tests::write_text(folder_ / "one.h5", stored_bytes(spectral({550}), true));
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  static double transmitted(const Bsdf& film) {
    const auto light = core::StokesVector::unpolarized(1.0, core::PolarizationFrame::any(tests::travel(20, 10)));
    return dynamic_cast<const TabulatedMueller&>(film).hemispherical(light, ScatterKind::transmission);
  }
  tests::TempFolder folder_;
};

TEST_F(MuellerFilmMaker, ReadsCsvAndHdf5) {
  for (const char* name : {"m.csv", "m.h5"}) {
    const Film film = film_of("{kind: mueller_table, axis_deg: 30, gap_mm: 0.2, table: " + path(name) + "}");
    EXPECT_EQ(film.kind, "mueller_table");
    EXPECT_EQ(film.gap, 0.2);
    EXPECT_NEAR(film.axis, core::kPi / 6, 1e-12);
    ASSERT_TRUE(film.surface && film.surface->scatters());
    ASSERT_TRUE(film.at_wavelength);
    EXPECT_NEAR(transmitted(*film.at_wavelength(450).surface), 0.05, 1e-6);
    EXPECT_NEAR(transmitted(*film.at_wavelength(550).surface), std::sqrt(0.05 * 0.25), 1e-6) << "ln S is linear";
    EXPECT_NEAR(transmitted(*film.at_wavelength(900).surface), 0.25, 1e-6);
    EXPECT_NEAR(transmitted(*film.surface), std::sqrt(0.05 * 0.25), 1e-6);
    EXPECT_THAT(film.remarks,
                ::testing::Contains(std::string(name) +
                                    ": data at 2 wavelengths from 450 to 650 nm; beyond these the nearest is "
                                    "used"));
  }
}

TEST_F(MuellerFilmMaker, OneWavelengthOrTheKeyServesAll) {
  const Film one = film_of("{kind: mueller_table, table: " + path("one.h5") + "}");
  EXPECT_FALSE(one.at_wavelength);
  EXPECT_THAT(one.remarks, ::testing::Contains("one.h5: data at 550 nm alone, used at every wavelength"));
  const Film key = film_of("{kind: mueller_table, wavelength_nm: 650, table: " + path("m.h5") + "}");
  EXPECT_FALSE(key.at_wavelength);
  EXPECT_NEAR(transmitted(*key.surface), 0.25, 1e-6);
}

TEST_F(MuellerFilmMaker, NormalizesToTotals) {
  tests::write_text(
      folder_ / "totals.csv",
      "sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block\n0,0.6,0,0.2,0\n");
  const Film film =
      film_of("{kind: mueller_table, table: " + path("one.h5") + ", hemispherical: " + path("totals.csv") + "}");
  EXPECT_NEAR(transmitted(*film.surface), 0.4, 1e-6);
  EXPECT_THAT(film.remarks[0], HasSubstr("one.h5: normalized to the hemispherical table; factors"));
}

TEST_F(MuellerFilmMaker, FramesByTheKey) {
  // At oblique incidence the two readings of the same numbers are different films.
  const core::Vec3 k = tests::travel(30, 70), out = tests::travel(50, 10);
  const auto light = core::StokesVector::linear(1.0, 0.2, tangential_frame(k).frame);
  const auto u = [&](const std::string& frames) {
    const Film film = film_of("{kind: mueller_table, frames: " + frames + ", table: " + path("one.h5") + "}");
    return film.surface->evaluate(light, out).U;
  };
  EXPECT_EQ(u("file"), u("film")) << "the comment names no frames";
  EXPECT_GT(std::abs(u("laboratory") - u("film")), 0.1 * std::abs(u("film")));
}

TEST_F(MuellerFilmMaker, RefusesOtherUnitsGainAndNothing) {
  const std::string text = csv_text(spectral({450, 650}));
  const auto written = [&](const char* name, const std::string& content) {
    tests::write_text(folder_ / name, content);
    return faults_of("{kind: mueller_table, table: " + path(name) + "}");
  };
  const std::string rows = text.substr(text.find("kind,"));
  EXPECT_EQ(written("bare.csv", rows), "accepted");
  EXPECT_THAT(written("rad.csv", "# radians, nm, 1/sr\n" + rows),
              HasSubstr("table: " + path("rad.csv") + ":1:1: the comment must name the units"));
  const auto scaled = [](double factor) {
    StoredTable table = spectral({550});
    for (auto& column : table.values) {
      for (double& value : column) value *= factor;
    }
    return csv_text(table);
  };
  EXPECT_EQ(written("some.csv", scaled(6.8)), "accepted") << "R + T = 0.15 x 6.8 = 1.02";
  EXPECT_THAT(written("gain.csv", scaled(7.2)), HasSubstr("must give R + T of at most 1.05"));
  EXPECT_THAT(written("zero.csv", scaled(0.0)), HasSubstr("must reflect or transmit, got tau 0 everywhere"));
}

TEST_F(MuellerFilmMaker, NamesFaults) {
  EXPECT_THAT(faults_of("{kind: mueller_table}"), HasSubstr("table"));
  EXPECT_THAT(faults_of("{kind: mueller_table, table: " + tests::data_file("dbef.csv") + "}"),
              HasSubstr("must hold Mueller matrices (m00 ... m33), got tau_min, tau_max, delta"));
  EXPECT_THAT(faults_of("{kind: dbef, table: " + path("m.h5") + "}"),
              HasSubstr("got Mueller matrices (film kind mueller_table)"));
  EXPECT_THAT(faults_of("{kind: mueller_table, frames: ship, table: " + path("m.h5") + "}"), HasSubstr("frames"));
  EXPECT_THAT(faults_of("{kind: mueller_table, axis_deg: 200, table: " + path("m.h5") + "}"), HasSubstr("axis_deg"));
  EXPECT_THAT(faults_of("{kind: mueller_table, hemispherical: " + path("m.csv") + ", table: " + path("m.h5") + "}"),
              HasSubstr("hemispherical"));
  tests::write_text(folder_ / "cut.h5", tests::file_text(folder_ / "m.h5").substr(0, 3000));
  EXPECT_THAT(faults_of("{kind: mueller_table, table: " + path("cut.h5") + "}"),
              HasSubstr("cut.h5: must have the SHA-256"));
}

}  // namespace
}  // namespace evenglow::tracer
