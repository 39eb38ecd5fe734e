#include "tracer/polarized_bsdf/stored_table.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/films.h"
#include "tests/support/mueller_films.h"
#include "tests/support/temp_folder.h"
#include "tracer/polarized_bsdf/bsdf_table.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

constexpr const char* kText =
    "# degrees, nm and 1/sr\n# second line\n"
    "lambda_nm,kind,psi_deg,sigma_deg,phi_deg,theta_deg,tau_max,tau_min,delta_deg,kappa\n"
    "650,BTDF,0,0,0,5,0.3,0.1,90,0.5\n"
    "450,BTDF,0,0,0,0,0.1,0.1,-0,1\n"
    "450,BTDF,0,0,0,5,0.2000000000000001,0.1,91.25,1\n"
    "650,BTDF,0,0,0,0,4.9406564584124654e-324,0,90,0.25\n";

TEST(StoredTable, SortsTheRowsOfAText) {
  const StoredTable table = parse_csv_table(kText, "film.csv");
  EXPECT_EQ(table.form, StoredForm::diattenuator);
  EXPECT_EQ(table.comment, "degrees, nm and 1/sr\nsecond line");
  EXPECT_EQ(table.kinds, std::vector<std::size_t>{1});
  EXPECT_EQ(table.axes[3], (std::vector<double>{0, 5}));
  EXPECT_EQ(table.axes[4], (std::vector<double>{450, 650}));
  ASSERT_EQ(table.nodes(), 4u);
  // theta, then lambda fastest
  EXPECT_EQ(table.values[1], (std::vector<double>{0.1, 4.9406564584124654e-324, 0.2000000000000001, 0.3}));
  EXPECT_TRUE(table.values[3].empty()) << "no tau_min_se";
  EXPECT_EQ(table.values.back(), (std::vector<double>{1, 0.25, 1, 0.5}));
}

TEST(StoredTable, CsvKeepsEveryBit) {
  const StoredTable table = parse_csv_table(kText, "film.csv");
  const StoredTable again = parse_csv_table(csv_text(table), "film.csv");
  EXPECT_EQ(again.comment, table.comment);
  EXPECT_EQ(again.axes, table.axes);
  ASSERT_EQ(again.values.size(), table.values.size());
  for (std::size_t c = 0; c < table.values.size(); ++c) {
    ASSERT_EQ(again.values[c].size(), table.values[c].size());
    for (std::size_t i = 0; i < table.values[c].size(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint64_t>(again.values[c][i]), std::bit_cast<std::uint64_t>(table.values[c][i]));
    }
  }
  EXPECT_EQ(csv_text(again), csv_text(table));
}

TEST(StoredTable, RowsMakeTheSameTable) {
  const BsdfTable direct = BsdfTable::parse(kText, "film.csv");
  const BsdfTable stored = BsdfTable::from_stored(parse_csv_table(kText, "film.csv"));
  for (const double lambda : {450.0, 500.0, 650.0}) {
    const auto a = direct.at(ScatterKind::transmission, 0.3, 0.1, 1.0, 0.05, lambda);
    const auto b = stored.at(ScatterKind::transmission, 0.3, 0.1, 1.0, 0.05, lambda);
    EXPECT_EQ(a.S, b.S);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.kappa, b.kappa);
  }
}

TEST(StoredTable, KnowsMuellerMatricesByTheirColumns) {
  const StoredTable table =
      tests::mueller_stored("m.csv", {0}, {{{0}, {0}, {0}, {0, 10}, {550}}},
                            [](const tests::NodeIndex&) { return core::diattenuator(0.25, 0.125); });
  const StoredTable again = parse_csv_table(csv_text(table), "m.csv");
  EXPECT_EQ(again.form, StoredForm::mueller);
  EXPECT_EQ(again.values[1], (std::vector<double>{0.0625, 0.0625}));  // m01
  EXPECT_THAT(csv_text(again), HasSubstr("lambda_nm,m00,m01"));
}

TEST(StoredTable, RefusesWhatTheTextReaderRefuses) {
  EXPECT_THROW(parse_csv_table("# radians\n", "a.csv"), core::ConfigError);
  EXPECT_THROW(parse_csv_table(std::string(kText) + "450,BTDF,0,0,0,0,1,1,0,1\n", "a.csv"), core::ConfigError);
  EXPECT_THROW(parse_stored_table(kText, "a.h5"), core::ConfigError) << "a text is no HDF5 file";
  EXPECT_THROW(read_table_bytes("/no/such/table.h5"), core::ConfigError);
}

TEST(StoredTable, TheEndingOfTheNameSelectsHdf5) {
  EXPECT_TRUE(names_hdf5("a/film.h5"));
  EXPECT_TRUE(names_hdf5("film.mueller.hdf5"));
  EXPECT_FALSE(names_hdf5("film.csv"));
  EXPECT_FALSE(names_hdf5("film.h5.csv"));
  const tests::TempFolder folder;
  const StoredTable table = parse_csv_table(tests::file_text(tests::data_file("dbef.csv")), "dbef.csv");
  tests::write_text(folder / "film.h5", stored_bytes(table, true));
  const BsdfTable csv = BsdfTable::read(tests::data_file("dbef.csv"));
  const BsdfTable h5 = BsdfTable::read(folder / "film.h5");
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const auto a = csv.at(kind, 0.4, 0.6, 1.0, 0.2, 550), b = h5.at(kind, 0.4, 0.6, 1.0, 0.2, 550);
    EXPECT_EQ(a.S, b.S);
    EXPECT_EQ(a.x, b.x);
    EXPECT_EQ(a.y, b.y);
  }
}

}  // namespace
}  // namespace evenglow::tracer
