#include "tracer/polarized_bsdf/hdf5_table.h"

#include <bit>
#include <functional>
#include <random>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/films.h"
#include "tests/support/leaks_allowed.h"
#include "tests/support/mueller_films.h"
#include "tests/support/temp_folder.h"
#include "tracer/polarized_bsdf/hdf5_writer.h"
#include "tracer/polarized_bsdf/table_check.h"

namespace evenglow::tracer {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

void expect_same_bits(const StoredTable& a, const StoredTable& b) {
  EXPECT_EQ(a.form, b.form);
  EXPECT_EQ(a.comment, b.comment);
  EXPECT_EQ(a.kinds, b.kinds);
  EXPECT_EQ(a.axes, b.axes);
  ASSERT_EQ(a.values.size(), b.values.size());
  for (std::size_t c = 0; c < a.values.size(); ++c) {
    ASSERT_EQ(a.values[c].size(), b.values[c].size());
    for (std::size_t i = 0; i < a.values[c].size(); ++i) {
      ASSERT_EQ(std::bit_cast<std::uint64_t>(a.values[c][i]), std::bit_cast<std::uint64_t>(b.values[c][i]));
    }
  }
}

/// Doubles of all sizes, least bits used.
StoredTable random_table() {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> exponent(-300.0, 0.0), one(0.0, 1.0);
  StoredTable table;
  table.name = "film.h5";
  table.comment = "degrees, nm, 1/sr; \xC2\xB5 and\na second line";
  table.kinds = {0, 1};
  table.axes = {{{0, 45.1, 90}, {0, 1.0 / 3.0}, {0, 90}, {0, 10, 20, 30}, {450, 550, 650.5}}};
  table.values.resize(7);  // no standard errors
  for (std::size_t i = 0; i < table.nodes(); ++i) {
    const double low = one(random) * std::pow(10.0, exponent(random));
    table.values[0].push_back(low);
    table.values[1].push_back(low + one(random));
    table.values[2].push_back(-180.0 + 360.0 * one(random));
    table.values[6].push_back(one(random));
  }
  return table;
}

TEST(Hdf5Table, KeepsEveryBit) {
  const StoredTable table = random_table();
  const std::string bytes = hdf5_table_bytes(table);
  expect_same_bits(table, parse_hdf5_table(bytes, "film.h5"));
  EXPECT_EQ(bytes, hdf5_table_bytes(table)) << "the same table gives the same file";
  // Through the text and back.
  expect_same_bits(table, parse_csv_table(csv_text(parse_hdf5_table(bytes, "film.h5")), "film.csv"));
}

TEST(Hdf5Table, TheDataAndTheirMatricesGoRound) {
  const StoredTable csv = parse_csv_table(tests::file_text(tests::data_file("dbef.csv")), "dbef.csv");
  const std::string bytes = hdf5_table_bytes(csv);
  expect_same_bits(csv, parse_hdf5_table(bytes, "dbef.h5"));
  EXPECT_LT(bytes.size(), csv_text(csv).size());
  const StoredTable mueller = tests::mueller_of(BsdfTable::read(tests::data_file("dbef.csv")), false);
  expect_same_bits(mueller, parse_hdf5_table(hdf5_table_bytes(mueller), "m.h5"));
}

TEST(Hdf5Table, ManyChunks) {
  StoredTable table = random_table();
  table.axes[4].clear();
  for (int i = 0; i < 2000; ++i) table.axes[4].push_back(400.0 + 0.1 * i);
  for (const std::size_t c : {0u, 1u, 2u, 6u}) {
    table.values[c].resize(table.nodes());
    for (std::size_t i = 0; i < table.nodes(); ++i) {
      table.values[c][i] = c < 2 ? 1e-3 * static_cast<double>(c + 1) + 1e-9 * static_cast<double>(i % 977) : 0.5;
    }
  }
  expect_same_bits(table, parse_hdf5_table(hdf5_table_bytes(table), "film.h5"));
}

// ---- Broken files: each is good but for one thing.

/// A small table written piece by piece, so that each piece can be another one.
struct Pieces {
  std::string format = "evenglow-film-table", form = "diattenuator", kind = "BRDF";
  long long version = 1;
  std::vector<std::pair<std::string, std::vector<double>>> axes{
      {"psi", {0}}, {"sigma", {0, 30}}, {"phi", {0}}, {"theta", {0, 10, 20}}, {"lambda", {550}}};
  std::vector<std::pair<std::string, std::vector<double>>> values{{"tau_min", {0.01, 0.01, 0.01, 0.01, 0.01, 0.01}},
                                                                  {"tau_max", {0.02, 0.02, 0.02, 0.02, 0.02, 0.02}},
                                                                  {"delta", {0, 0, 0, 0, 0, 0}}};
  std::vector<std::size_t> shape{1, 1, 2, 1, 3, 1};
  std::function<std::string(const std::string&)> unit = [](const std::string& name) -> std::string {
    if (name == "lambda") return "nm";
    return name.starts_with("tau") ? "1/sr" : "deg";
  };

  std::string bytes() const {
    Hdf5Writer file;
    if (!format.empty()) file.text("", "format", format);
    file.integer("", "version", version);
    file.text("", "form", form);
    file.text("", "kind", kind);
    for (const auto& [name, axis] : axes) {
      file.numbers(name, std::array{axis.size()}, std::array{std::min<std::size_t>(axis.size(), 65536)}, axis);
      if (!unit(name).empty()) file.text(name, "unit", unit(name));
    }
    for (const auto& [name, column] : values) {
      file.numbers(name, shape, shape, column);
      if (!unit(name).empty()) file.text(name, "unit", unit(name));
    }
    return file.bytes();
  }
};

std::string fault_of(const std::string& bytes) {
  try {
    parse_hdf5_table(bytes, "film.h5");
  } catch (const core::ConfigError& error) {
    EXPECT_LE(error.faults().size(), 10u);
    return error.what();
  }
  return "accepted";
}

std::string fault_with(const std::function<void(Pieces&)>& damage) {
  Pieces pieces;
  damage(pieces);
  return fault_of(pieces.bytes());
}

TEST(Hdf5TableFaults, TheUndamagedFileIsGood) {
  EXPECT_EQ(fault_with([](Pieces&) {}), "accepted");
}

TEST(Hdf5TableFaults, NoHdf5File) {
  EXPECT_EQ(fault_of("kind,psi_deg\n"), "film.h5: must be an HDF5 file, got none (its first bytes are others)");
  EXPECT_THAT(fault_of(""), HasSubstr("must be an HDF5 file"));
  EXPECT_THAT(fault_of("\x89HDF\r\n\x1a\n and nothing more"), HasSubstr("must be a whole HDF5 file"));
  EXPECT_THAT(fault_of("Evenglow HDF5, SHA-256 of all after byte 512: "), HasSubstr("must have the SHA-256"));
}

TEST(Hdf5TableFaults, CutShort) {
  const std::string bytes = Pieces().bytes();
  for (const double share : {0.02, 0.3, 0.6, 0.9, 0.999}) {
    EXPECT_THAT(fault_of(bytes.substr(0, static_cast<std::size_t>(share * static_cast<double>(bytes.size())))),
                AllOf(StartsWith("film.h5: "), testing::Not(HasSubstr("accepted"))));
  }
}

TEST(Hdf5TableFaults, AnotherFormatVersionFormOrKind) {
  EXPECT_EQ(fault_with([](Pieces& p) { p.format = "measurement"; }),
            "film.h5: format: must be 'evenglow-film-table', got 'measurement'");
  EXPECT_EQ(fault_with([](Pieces& p) { p.format = ""; }), "film.h5: format: must be 'evenglow-film-table', got 'none'");
  EXPECT_EQ(fault_with([](Pieces& p) { p.version = 2; }), "film.h5: version: must be 1, got 2");
  EXPECT_THAT(fault_with([](Pieces& p) { p.form = "jones"; }), HasSubstr("form: must be diattenuator or mueller"));
  EXPECT_THAT(fault_with([](Pieces& p) { p.kind = "BSDF"; }), HasSubstr("kind: must be BRDF,BTDF, BRDF or BTDF"));
}

TEST(Hdf5TableFaults, MissingAndUnknownDatasets) {
  EXPECT_EQ(fault_with([](Pieces& p) { p.values.erase(p.values.begin() + 1); }),
            "film.h5: tau_max: is a required dataset, got none");
  EXPECT_EQ(fault_with([](Pieces& p) { p.axes.erase(p.axes.begin() + 3); }),
            "film.h5: theta: is a required dataset, got none");
  EXPECT_EQ(fault_with([](Pieces& p) {
              p.values.push_back({"gain", p.values[0].second});
            }),
            "film.h5: must hold nothing but datasets of the form diattenuator, got 8 of them among 9 names");
  EXPECT_THAT(fault_with([](Pieces& p) { p.form = "mueller"; }), HasSubstr("m00: is a required dataset, got none"));
}

TEST(Hdf5TableFaults, AxesThatDoNotAscendOrLeaveTheirRange) {
  EXPECT_EQ(fault_with([](Pieces& p) {
              p.axes[3].second = {0, 20, 10};
            }),
            "film.h5: theta: must ascend, got 10 after 20");
  EXPECT_EQ(fault_with([](Pieces& p) {
              p.axes[3].second = {0, 10, 10};
            }),
            "film.h5: theta: must ascend, got 10 after 10");
  EXPECT_EQ(fault_with([](Pieces& p) {
              p.axes[1].second = {0, 90};
            }),
            "film.h5: sigma: must be a number in [0, 90), got 90");
  EXPECT_EQ(fault_with([](Pieces& p) { p.axes[4].second = {std::nan("")}; }),
            "film.h5: lambda: must be a number in [100, 10000], got nan");
}

TEST(Hdf5TableFaults, ValuesOutOfTheirRange) {
  EXPECT_EQ(fault_with([](Pieces& p) { p.values[1].second[4] = std::nan(""); }),
            "film.h5: tau_max: must be a number in [0, 1e12], got nan at BRDF psi 0 sigma 30 phi 0 theta 10 lambda "
            "550");
  EXPECT_THAT(fault_with([](Pieces& p) { p.values[1].second[0] = INFINITY; }), HasSubstr("tau_max: must be"));
  EXPECT_THAT(fault_with([](Pieces& p) { p.values[0].second[0] = -1e-9; }), HasSubstr("got -1e-09"));
  EXPECT_EQ(fault_with([](Pieces& p) { p.values[0].second[5] = 3; }),
            "film.h5: tau_min: must be at most tau_max = 0.02, got 3 at BRDF psi 0 sigma 30 phi 0 theta 20 lambda 550");
}

TEST(Hdf5TableFaults, UnitsAndShapes) {
  EXPECT_EQ(fault_with([](Pieces& p) {
              p.unit = [](const std::string& name) -> std::string {
                return name == "lambda" ? "um" : name.starts_with("tau") ? "1/sr" : "deg";
              };
            }),
            "film.h5: lambda: must have the unit 'nm', got 'um'");
  EXPECT_THAT(fault_with([](Pieces& p) { p.unit = [](const std::string&) { return std::string(); }; }),
              HasSubstr("psi: must have the unit 'deg', got 'none'"));
  EXPECT_EQ(fault_with([](Pieces& p) { p.shape = {1, 1, 3, 1, 2, 1}; }).substr(0, 93),
            "film.h5: tau_min: must have the shape [1, 1, 2, 1, 3, 1] (kind, psi, sigma, phi, theta, lambd");
  EXPECT_THAT(fault_with([](Pieces& p) { p.shape = {6}; }), HasSubstr("got [6]"));
  EXPECT_THAT(fault_with([](Pieces& p) {
                p.axes.pop_back();
                p.values.push_back({"lambda", {1, 2, 3, 4, 5, 6}});
              }),
              HasSubstr("lambda: must have one dimension, got 6"));
}

TEST(Hdf5TableFaults, AbsurdSizesCostNoMemory) {
  std::vector<double> angles(20000);
  for (std::size_t i = 0; i < angles.size(); ++i) angles[i] = 1e-3 * static_cast<double>(i);
  EXPECT_EQ(fault_with([&](Pieces& p) {
              for (std::size_t a : {0u, 1u, 2u, 3u}) p.axes[a].second = angles;
            }),
            "film.h5: must hold at most 33554432 numbers, got more");
  EXPECT_THAT(fault_with([&](Pieces& p) {
                p.axes[2].second.resize(200000);
                for (std::size_t i = 0; i < 200000; ++i) p.axes[2].second[i] = 1e-4 * static_cast<double>(i);
              }),
              HasSubstr("phi: must hold 1 to 100000 numbers, got more"));
}

TEST(Hdf5TableFaults, UnphysicalMatrices) {
  StoredTable table = tests::mueller_stored("m.h5", {0}, {{{0}, {0}, {0}, {0, 10}, {550}}},
                                            [](const tests::NodeIndex& i) -> core::MuellerMatrix {
                                              core::MuellerMatrix M = 0.1 * core::MuellerMatrix::Identity();
                                              if (i[4] == 1) M(3, 3) = -0.1;
                                              return M;
                                            });
  EXPECT_THAT(fault_of(hdf5_table_bytes(table)),
              AllOf(HasSubstr("m00: the matrix must be physical"), HasSubstr("theta 10")));
}

/// Random damage of the bytes: how many copies were accepted, each with the same table.
int accepted_after_damage(const std::string& good, int tries) {
  const tests::LeaksAllowed leaks;  // HDF5 1.10.8 leaks some bytes of a header that it refuses
  const StoredTable table = parse_hdf5_table(good, "film.h5");
  std::mt19937 random(11);
  int accepted = 0;
  for (int i = 0; i < tries; ++i) {
    std::string bytes = good;
    for (int k = 0; k < 1 + i % 4; ++k) bytes[random() % bytes.size()] ^= static_cast<char>(1 + random() % 255);
    try {
      expect_same_bits(table, parse_hdf5_table(bytes, "film.h5"));
      ++accepted;
    } catch (const core::ConfigError&) {
      // as it should be
    }
  }
  return accepted;
}

std::string small_mueller_file() {
  return hdf5_table_bytes(tests::mueller_stored(
      "m.h5", {0}, {{{0}, {0}, {0}, {0, 10}, {550}}},
      [](const tests::NodeIndex&) -> core::MuellerMatrix { return 0.1 * core::MuellerMatrix::Identity(); }));
}

TEST(Hdf5TableFaults, DamagedBytesAreNeverAccepted) {
  EXPECT_EQ(accepted_after_damage(Pieces().bytes(), 1000), 0);
  EXPECT_EQ(accepted_after_damage(small_mueller_file(), 1000), 0);
}

/// Without the user block: one clear error or, where the damage lies between the parts of the file, the same table;
/// never a crash, never another table. Headers and data have checksums.
TEST(Hdf5TableFaults, DamagedBytesOfOtherProgramsNeverCrashOrChangeTheTable) {
  EXPECT_LT(accepted_after_damage(Pieces().bytes().substr(512), 1000), 500);
  EXPECT_LT(accepted_after_damage(small_mueller_file().substr(512), 1000), 500);
}

TEST(Hdf5TableCheck, FilmCheckReadsHdf5) {
  const StoredTable table = parse_csv_table(tests::file_text(tests::data_file("dbef.csv")), "dbef.csv");
  const TableCheck check = check_table(hdf5_table_bytes(table), "film.h5");
  EXPECT_TRUE(check.faults.empty());
  ASSERT_EQ(check.hemispherical.size(), 6u);
  EXPECT_NEAR(check.hemispherical[0].transmittance_pass, 0.887, 0.01);
  StoredTable brighter = table;
  for (const std::size_t c : {0u, 1u}) {
    for (double& value : brighter.values[c]) value *= 1.1;
  }
  const TableCheck wrong = check_table(hdf5_table_bytes(brighter), "film.h5");
  ASSERT_FALSE(wrong.faults.empty());
  EXPECT_THAT(wrong.faults[0].to_string(),
              AllOf(StartsWith("film.h5: R + T of any polarization must be at most 1"), HasSubstr("at psi 0 sigma 0")));
  EXPECT_FALSE(check_table("no such thing", "film.h5").faults.empty());
}

}  // namespace
}  // namespace evenglow::tracer
