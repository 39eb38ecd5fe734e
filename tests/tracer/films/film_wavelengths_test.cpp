#include "tracer/films/film_wavelengths.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/film_bins.h"
#include "tests/support/films.h"
#include "tests/support/spectral_film.h"
#include "tests/support/temp_folder.h"
#include "tracer/films/dbef.h"
#include "tracer/films/film_registry.h"
#include "tracer/polarized_bsdf/stored_table.h"

namespace evenglow::tracer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using tests::SpectralFilm;

Film film_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("film: " + yaml, "run.yaml");
  auto film = film_registry().make(document.root().map("film", "a film", true));
  document.finish();
  return std::move(film.value());
}

/// Share that a film reflects of light with these Q, U (counted from its axis at 0), at normal incidence.
double reflected(const Bsdf& film, double q, double u) {
  const auto light = from_film({1.0, q, u, 0.0}, tangential_frame(core::Vec3(0, 0, -1)));
  return dynamic_cast<const TabulatedDbef&>(film).hemispherical(light, ScatterKind::reflection);
}

class SpectralTable : public testing::Test {
 protected:
  SpectralTable() {
    tests::write_text(folder_ / "film.csv", SpectralFilm::csv({450, 650}));
    tests::write_text(folder_ / "one.csv", SpectralFilm::csv({620}));
    tests::write_text(folder_ / "film.h5",
                      stored_bytes(parse_csv_table(SpectralFilm::csv({450, 500, 620, 650}), "film.csv"), true));
  }
  std::string path(const char* name) const { return (folder_ / name).string(); }
  tests::TempFolder folder_;
};

TEST_F(SpectralTable, FollowsTheLawBetweenItsWavelengths) {
  for (const char* name : {"film.csv", "film.h5"}) {
    const Film film = film_of("{kind: dbef, table: " + path(name) + "}");
    ASSERT_TRUE(film.at_wavelength);
    for (const double nm : {450.0, 472.0, 550.0, 613.5, 650.0}) {
      const FilmOptics optics = film.at_wavelength(nm);
      for (const auto& [q, u] : {std::pair{0.0, 0.0}, {1.0, 0.0}, {0.6, -0.8}}) {
        // 5e-5: shares are stored as 16-bit numbers.
        EXPECT_NEAR(reflected(*optics.surface, q, u), SpectralFilm::total(nm, q, u), 1e-4) << name << " " << nm;
      }
    }
    EXPECT_NEAR(reflected(*film.surface, 1.0, 0.0), SpectralFilm::total(550.0, 1.0, 0.0), 1e-4);
  }
}

TEST_F(SpectralTable, HoldsBeyondItsWavelengthsAndSaysSo) {
  const Film film = film_of("{kind: dbef, table: " + path("film.csv") + "}");
  EXPECT_NEAR(reflected(*film.at_wavelength(380.0).surface, 1.0, 0.0), SpectralFilm::total(450.0, 1.0, 0.0), 1e-4);
  EXPECT_NEAR(reflected(*film.at_wavelength(780.0).surface, 1.0, 0.0), SpectralFilm::total(650.0, 1.0, 0.0), 1e-4);
  EXPECT_THAT(
      film.remarks,
      ::testing::Contains("film.csv: data at 2 wavelengths from 450 to 650 nm; beyond these the nearest is used"));
}

TEST_F(SpectralTable, TheKeyOverrides) {
  const Film film = film_of("{kind: dbef, wavelength_nm: 480, table: " + path("film.csv") + "}");
  EXPECT_FALSE(film.at_wavelength);
  EXPECT_NEAR(reflected(*film.surface, 1.0, 0.0), SpectralFilm::total(480.0, 1.0, 0.0), 1e-4);
  EXPECT_THAT(film.remarks, ::testing::SizeIs(1));  // that the data end at sigma = 0
  const Film beyond = film_of("{kind: dbef, wavelength_nm: 700, table: " + path("film.csv") + "}");
  EXPECT_THAT(beyond.remarks,
              ::testing::Contains("film.csv: wavelength_nm 700 lies beyond the data (450 to 650 nm); the "
                                  "nearest is used"));
}

TEST_F(SpectralTable, OneWavelengthServesAll) {
  const Film film = film_of("{kind: dbef, table: " + path("one.csv") + "}");
  EXPECT_FALSE(film.at_wavelength) << "nothing is to be resampled";
  EXPECT_NEAR(reflected(*film.surface, 1.0, 0.0), SpectralFilm::total(620.0, 1.0, 0.0), 1e-4);
  EXPECT_THAT(film.remarks, ::testing::Contains("one.csv: data at 620 nm alone, used at every wavelength"));
}

constexpr const char* kTotals = "sigma_deg,transmittance_pass,reflectance_pass,transmittance_block,reflectance_block";

TEST_F(SpectralTable, IsNormalizedToTheTotalsOfItsWavelength) {
  tests::write_text(folder_ / "totals.csv",
                    std::string(kTotals) + ",lambda_nm\n0,0,0.1,0,0.3,450\n90,0,0.1,0,0.3,450\n0,0,0.3,0,0.7,650\n");
  const Film film = film_of("{kind: dbef, table: " + path("film.csv") + ", hemispherical: " + path("totals.csv") + "}");
  ASSERT_TRUE(film.at_wavelength);
  for (const auto& [nm, pass, block] : {std::tuple{450.0, 0.1, 0.3}, {500.0, 0.15, 0.4}, {700.0, 0.3, 0.7}}) {
    const FilmOptics optics = film.at_wavelength(nm);
    EXPECT_NEAR(reflected(*optics.surface, 1.0, 0.0), pass, 2e-4);
    EXPECT_NEAR(reflected(*optics.surface, -1.0, 0.0), block, 2e-4);
  }
  tests::write_text(folder_ / "gray.csv", std::string(kTotals) + "\n0,0,0.1,0,0.3\n");
  const Film gray = film_of("{kind: dbef, table: " + path("film.csv") + ", hemispherical: " + path("gray.csv") + "}");
  EXPECT_THAT(gray.remarks.back(), HasSubstr("same hemispherical totals at every wavelength"));
  EXPECT_NEAR(reflected(*gray.at_wavelength(620).surface, 1.0, 0.0), 0.1, 2e-4);
}

TEST_F(SpectralTable, ASpectralTotalOfAGrayTableIsSpectral) {
  tests::write_text(folder_ / "totals.csv",
                    std::string(kTotals) + ",lambda_nm\n0,0,0.1,0,0.3,450\n0,0,0.3,0,0.7,650\n");
  const Film film = film_of("{kind: dbef, table: " + path("one.csv") + ", hemispherical: " + path("totals.csv") + "}");
  ASSERT_TRUE(film.at_wavelength);
  EXPECT_NEAR(reflected(*film.at_wavelength(550).surface, 1.0, 0.0), 0.2, 2e-4);
}

TEST(FilmWavelengths, RemarksNameTheirFileAlone) {
  EXPECT_THAT(without_folders({"/a/b/film.csv: R / T above 1", "film.csv: x/y"}),
              ElementsAre("film.csv: R / T above 1", "film.csv: x/y"));
}

}  // namespace
}  // namespace evenglow::tracer
