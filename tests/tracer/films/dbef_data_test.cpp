#include "tracer/films/dbef_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using ::testing::HasSubstr;

std::optional<DbefData> data_of(const std::string& yaml) {
  const core::ConfigDocument document = core::ConfigDocument::parse("film: " + yaml, "run.yaml");
  const core::ConfigNode film = document.root().map("film", "");
  if (!has_dbef_data(film)) return std::nullopt;
  auto data = read_dbef_data(film);
  document.finish();
  return data;
}

std::string faults_of(const std::string& yaml) {
  try {
    data_of(yaml);
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "";
}

TEST(DbefData, ASpecularFilmHasNone) {
  EXPECT_FALSE(data_of("{axis_deg: 0}"));
}

TEST(DbefData, ATableKeepsItsWavelength) {
  const auto data = data_of("{table: " + tests::data_file("dbef.csv") +
                            ", hemispherical: " + tests::data_file("dbef_hemispherical.csv") + "}");
  ASSERT_TRUE(data);
  EXPECT_TRUE(data->totals);
  EXPECT_FALSE(data->follows_wavelength);  // one wavelength serves all
  EXPECT_EQ(data->wavelength_nm, kFilmWavelength);
  EXPECT_EQ(data->table.axes().sigma.size(), 6U);
}

TEST(DbefData, TheModelHasTheTotalsOfItsReadme) {
  // configs/data/README.md at normal incidence: T_p .887, R_p .098, T_b .053, R_b .932, each to its last digit.
  const auto data = data_of("{model: {}}");
  ASSERT_TRUE(data);
  ASSERT_TRUE(data->totals);
  const HemisphericalTable::Row row = data->totals->at(0.0);
  EXPECT_NEAR(row.transmittance_pass, 0.887, 6e-4);
  EXPECT_NEAR(row.reflectance_pass, 0.098, 8e-4);
  EXPECT_NEAR(row.transmittance_block, 0.053, 6e-4);
  EXPECT_NEAR(row.reflectance_block, 0.932, 6e-4);
}

TEST(DbefData, WrongOnesAreRefused) {
  EXPECT_THAT(faults_of("{table: none.csv}"), HasSubstr("film.table: must be an existing file"));
  EXPECT_THAT(faults_of("{model: {absorption: 0.2}}"), HasSubstr("film.model"));
  EXPECT_THAT(faults_of("{model: {sx: -1}}"), HasSubstr("film.model.sx"));
}

}  // namespace
}  // namespace evenglow::tracer
