#include "tracer/polarized_bsdf/table_check.h"

#include <algorithm>
#include <functional>
#include <sstream>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/text_file.h"
#include "tests/support/films.h"
#include "tests/support/mueller_films.h"
#include "tracer/polarized_bsdf/table_symmetry.h"

namespace evenglow::tracer {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::IsEmpty;
using tests::data_file;
using Lines = std::vector<std::string>;

/// Lines of the data file; line n of a message is [n - 1]. Data begin at line 3.
const Lines& good_lines() {
  static const Lines lines = [] {
    Lines result;
    std::istringstream text(core::read_text_file(data_file("dbef.csv")));
    for (std::string line; std::getline(text, line);) result.push_back(line);
    return result;
  }();
  return lines;
}

std::string joined(const Lines& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + '\n';
  return text;
}

TableCheck check_with(const std::function<void(Lines&)>& damage, const TableCheckOptions& options = {}) {
  Lines lines = good_lines();
  damage(lines);
  return check_table(joined(lines), "film.csv", options);
}

/// All faults of a damaged table, one to a line.
std::string faults_with(const std::function<void(Lines&)>& damage, const TableCheckOptions& options = {}) {
  std::string text;
  for (const core::Fault& fault : check_with(damage, options).faults) text += fault.to_string() + '\n';
  return text;
}

Lines entries(const std::string& line) {
  Lines result;
  std::istringstream text(line);
  for (std::string entry; std::getline(text, entry, ',');) result.push_back(entry);
  return result;
}

std::string row(const Lines& entries) {
  std::string text;
  for (const std::string& entry : entries) text += (text.empty() ? "" : ",") + entry;
  return text;
}

/// Multiplies tau of the rows that `picks` (kind, psi, sigma, phi, theta ...).
void scale_rows(Lines& lines, double factor, const std::function<bool(const Lines&)>& picks) {
  for (std::size_t i = 2; i < lines.size(); ++i) {
    Lines e = entries(lines[i]);
    if (!picks(e)) continue;
    for (const std::size_t c : {std::size_t{6}, std::size_t{7}}) e[c] = fmt::format("{}", std::stod(e[c]) * factor);
    lines[i] = row(e);
  }
}

TEST(TableCheck, TheDataFilePasses) {
  const TableCheck plain = check_with([](Lines&) {});
  EXPECT_THAT(plain.faults, IsEmpty());
  const auto totals = HemisphericalTable::read(data_file("dbef_hemispherical.csv"));
  TableCheckOptions options;
  options.hemispherical = &totals;
  EXPECT_THAT(check_with([](Lines&) {}, options).faults, IsEmpty());
  ASSERT_EQ(plain.hemispherical.size(), 6u);
  // The model's values (README), met by interpolation within 1.5 %.
  EXPECT_NEAR(plain.hemispherical[0].transmittance_pass, 0.887, 0.01);
  EXPECT_NEAR(plain.hemispherical[0].reflectance_pass, 0.098, 0.01);
  EXPECT_NEAR(plain.hemispherical[0].transmittance_block, 0.053, 0.01);
  EXPECT_NEAR(plain.hemispherical[0].reflectance_block, 0.932, 0.01);
  EXPECT_LT(plain.hemispherical[5].greatest, 1.0);
}

TEST(TableCheck, NamesTauMinAboveTauMax) {
  EXPECT_THAT(faults_with([](Lines& l) { l[99] = "BRDF,0,0,225,12,550,3,2,0"; }),
              HasSubstr("film.csv:100:21: tau_min: must be at most tau_max = 2, got 3"));
}

TEST(TableCheck, NamesNotANumber) {
  EXPECT_THAT(faults_with([](Lines& l) {
                Lines e = entries(l[9]);
                e[7] = "nan";
                l[9] = row(e);
              }),
              AllOf(HasSubstr("film.csv:10:"), HasSubstr("tau_max: must be a number in [0, 1e12], got 'nan'")));
}

TEST(TableCheck, NamesTextInARow) {
  EXPECT_THAT(faults_with([](Lines& l) { l[49] = "see the other file"; }),
              HasSubstr("film.csv:50:1: must have 9 entries as the header (line 2), got 1"));
}

TEST(TableCheck, NamesAFileThatIsNoTable) {
  const TableCheck check = check_table("Dear colleague,\nthe table follows.\n", "film.csv");
  ASSERT_EQ(check.faults.size(), 2u);
  EXPECT_THAT(check.faults[0].to_string(), HasSubstr("film.csv:1:1: the comment must name the units"));
  EXPECT_THAT(check.faults[1].to_string(), HasSubstr("film.csv:1:1: columns must be kind,psi_deg"));
  EXPECT_FALSE(check_table("", "film.csv").faults.empty());
}

TEST(TableCheck, NamesAMissingNode) {
  EXPECT_THAT(faults_with([](Lines& l) { l.erase(l.begin() + 1000); }),
              AllOf(HasSubstr("film.csv:1000:1: must hold every node of its grid, got none for BRDF"),
                    testing::Not(HasSubstr("\nfilm.csv:"))));
}

TEST(TableCheck, NamesARepeatedRow) {
  EXPECT_THAT(faults_with([](Lines& l) { l.insert(l.begin() + 500, l[400]); }),
              HasSubstr("film.csv:501:1: must hold each node once, got BRDF"));
  EXPECT_THAT(faults_with([](Lines& l) { l.insert(l.begin() + 500, l[400]); }), HasSubstr("(first on line 401)"));
}

TEST(TableCheck, NamesRowsOutOfOrder) {
  EXPECT_THAT(faults_with([](Lines& l) { std::swap(l[700], l[900]); }),
              HasSubstr("film.csv:702:1: rows must be in the order of the grid, got BRDF"));
}

TEST(TableCheck, AnyOrderOfTheColumnsIsAnOrder) {
  EXPECT_THAT(faults_with([](Lines& l) {
                std::stable_sort(l.begin() + 2, l.end(), [](const std::string& a, const std::string& b) {
                  return std::stod(entries(a)[4]) < std::stod(entries(b)[4]);
                });
              }),
              IsEmpty());
}

TEST(TableCheck, NamesATruncatedFile) {
  EXPECT_THAT(faults_with([](Lines& l) { l.resize(5000); }),
              HasSubstr("film.csv:5000:1: must hold every node of its grid, got a file that ends 1530 nodes early "
                        "(truncated?)"));
  EXPECT_THAT(faults_with([](Lines& l) {
                l.resize(5000);
                l.back().resize(12);
              }),
              HasSubstr("film.csv:5000:1: must have 9 entries as the header (line 2), got"));
}

TEST(TableCheck, NamesWrongUnits) {
  EXPECT_THAT(faults_with([](Lines& l) { l[0] = "# psi, sigma in radians, lambda in nm, tau in 1/sr"; }),
              HasSubstr("film.csv:1:1: the comment must name the units degrees, nm and 1/sr, got 'radians'"));
  EXPECT_THAT(faults_with([](Lines& l) { l[0] = "# degrees, um, 1/sr"; }), HasSubstr("got 'um'"));
  EXPECT_THAT(faults_with([](Lines& l) { l[0] = "# degrees, nm, percent"; }), HasSubstr("got 'percent'"));
  EXPECT_THAT(faults_with([](Lines& l) { l[0] = "# degrees and nm"; }), HasSubstr("got one without 1/sr"));
  EXPECT_THAT(faults_with([](Lines& l) { l.erase(l.begin()); }), HasSubstr("on the first line, got none"));
  EXPECT_THAT(faults_with([](Lines& l) { l[0] = "# deg, nm, sr^-1"; }), IsEmpty());
}

TEST(TableCheck, NamesLightOutOfNothing) {
  const auto brighter = [](Lines& l) {
    scale_rows(l, 1.1, [](const Lines& e) { return e[1] == "45" && e[2] == "30"; });
  };
  const std::string faults = faults_with(brighter);
  EXPECT_THAT(faults, HasSubstr("R + T of any polarization must be at most 1 (tolerance 0.02), got 1.08"));
  EXPECT_THAT(faults, HasSubstr("at psi 45 sigma 30 lambda 550"));
  EXPECT_EQ(std::ranges::count(faults, '\n'), 1);
  const auto line = good_lines().begin() + std::stoi(faults.substr(9)) - 1;
  EXPECT_TRUE(line->starts_with("BRDF,45,30,0,0,")) << *line;
}

TEST(TableCheck, SmallExcessIsARemark) {
  const TableCheck check = check_with([](Lines& l) { scale_rows(l, 1.015, [](const Lines&) { return true; }); });
  EXPECT_THAT(check.faults, IsEmpty());
  EXPECT_THAT(check.remarks, testing::Contains(HasSubstr("within the tolerance of interpolation")));
}

TEST(TableCheck, AHemisphericalTableTurnsExcessIntoAFactor) {
  const auto totals = HemisphericalTable::read(data_file("dbef_hemispherical.csv"));
  TableCheckOptions options;
  options.hemispherical = &totals;
  const auto scaled = [](double factor) {
    return [factor](Lines& l) { scale_rows(l, factor, [](const Lines&) { return true; }); };
  };
  EXPECT_THAT(faults_with(scaled(1.1), options), IsEmpty()) << "the sampler normalizes this";
  EXPECT_THAT(faults_with(scaled(1.5), options), HasSubstr("must agree with the hemispherical table"));
  EXPECT_THAT(faults_with(scaled(0.5), options), HasSubstr("must agree with the hemispherical table"));
}

TEST(TableCheck, NamesAFilmThatIsNotReciprocal) {
  // More light away from the normal, less towards it: a reversed path swaps the two.
  const std::string faults = faults_with([](Lines& l) {
    scale_rows(l, 1.3, [](const Lines& e) { return e[0] == "BTDF" && (e[3] == "0" || e[3] == "45" || e[3] == "315"); });
    scale_rows(l, 0.7,
               [](const Lines& e) { return e[0] == "BTDF" && (e[3] == "180" || e[3] == "135" || e[3] == "225"); });
  });
  EXPECT_THAT(faults, HasSubstr("BTDF must be reciprocal within 0.1 on average"));
  EXPECT_THAT(faults, testing::Not(HasSubstr("BRDF must be reciprocal")));
}

TEST(TableCheck, NamesASingleNodeFarFromItsReversedPath) {
  Lines target = good_lines();
  std::size_t line = 0;
  for (std::size_t i = 2; i < target.size(); ++i) {
    if (target[i].starts_with("BRDF,45,30,90,20,")) line = i + 1;
  }
  ASSERT_GT(line, 0u);
  const std::string faults = faults_with([&](Lines& l) {
    scale_rows(l, 0.005, [](const Lines& e) { return row({e[0], e[1], e[2], e[3], e[4]}) == "BRDF,45,30,90,20"; });
  });
  EXPECT_THAT(faults,
              HasSubstr(fmt::format("film.csv:{}:1: BRDF must be within a factor of 10 of the reversed path", line)));
}

TEST(TableCheck, RemarksOnMirrorSymmetryAxesAndKinds) {
  const auto remarks = [](const std::function<void(Lines&)>& damage) {
    std::string text;
    for (const std::string& remark : check_with(damage).remarks) text += remark + '\n';
    return text;
  };
  EXPECT_THAT(
      remarks([](Lines& l) { scale_rows(l, 0.9, [](const Lines& e) { return e[3] == "45" || e[3] == "90"; }); }),
      HasSubstr("mirrored in psi and phi"));
  EXPECT_THAT(remarks([](Lines& l) {
                for (std::size_t i = 2; i < l.size(); ++i) {
                  Lines e = entries(l[i]);
                  e[8] = fmt::format("{}", std::stod(e[8]) * 3.14159265 / 180.0);
                  l[i] = row(e);
                }
              }),
              HasSubstr("pass light is transmitted less than block light"));
  EXPECT_THAT(remarks([](Lines& l) { std::erase_if(l, [](const std::string& s) { return s.starts_with("BTDF"); }); }),
              HasSubstr("no BTDF rows"));
}

TEST(TableCheck, NamesUnphysicalMuellerMatrices) {
  const std::string header =
      "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,m00,m01,m02,m03,m10,m11,m12,m13,m20,m21,"
      "m22,m23,m30,m31,m32,m33\n";
  const TableCheck good = check_table(header + "BRDF,0,0,0,0,550,.1,0,0,0,0,.1,0,0,0,0,.1,0,0,0,0,.1\n", "m.csv");
  EXPECT_THAT(good.faults, IsEmpty());
  const TableCheck bad = check_table(header + "BRDF,0,0,0,0,550,.1,0,0,0,0,.1,0,0,0,0,.1,0,0,0,0,.1\n" +
                                         "BRDF,0,0,0,1,550,.1,0,0,0,0,.1,0,0,0,0,.1,0,0,0,0,-.1\n",
                                     "m.csv");
  ASSERT_EQ(bad.faults.size(), 1u);
  EXPECT_THAT(bad.faults[0].to_string(), HasSubstr("m.csv:4:18: m00: the matrix must be physical"));
  EXPECT_THAT(bad.faults[0].to_string(), HasSubstr("got -0.5"));
}

TEST(TableCheck, ChecksMuellerMatricesAsItDoesTables) {
  const BsdfTable dbef = BsdfTable::read(data_file("dbef.csv"));
  StoredTable stored = tests::mueller_of(dbef, false);
  const TableCheck good = check_table(csv_text(stored), "m.csv");
  EXPECT_THAT(good.faults, IsEmpty());
  ASSERT_EQ(good.hemispherical.size(), 6u);
  EXPECT_NEAR(good.hemispherical[0].transmittance_pass, 0.887, 0.01);
  EXPECT_NEAR(good.hemispherical[0].reflectance_block, 0.932, 0.01);
  // Light out of nothing, for all and for circular light alone.
  for (std::size_t e = 0; e < 16; ++e) {
    for (double& value : stored.values[e]) value *= 1.2;
  }
  const TableCheck bright = check_table(csv_text(stored), "m.csv");
  ASSERT_THAT(bright.faults, testing::Not(IsEmpty()));
  EXPECT_THAT(bright.faults[0].to_string(), HasSubstr("R + T of any polarization must be at most 1"));
  const auto circular = [](double share) {
    const StoredTable table =
        tests::mueller_stored("c.csv", {0}, {{{0}, {0}, {0}, {0, 60}, {550}}}, [&](const tests::NodeIndex&) {
          core::MuellerMatrix M = core::MuellerMatrix::Zero();
          M(0, 0) = M(0, 3) = share;
          return M;
        });
    return check_table(csv_text(table), "c.csv").faults.size();
  };
  EXPECT_EQ(circular(0.15), 0u) << "0.94 of right circular light";
  EXPECT_EQ(circular(0.17), 1u) << "1.07 of it, 0.53 of natural light";
}

TEST(TableCheck, NamesMissingNodesOfMuellerMatrices) {
  const StoredTable stored = tests::mueller_stored("c.csv", {0}, {{{0}, {0}, {0, 90}, {0, 60}, {550}}},
                                                   [&](const tests::NodeIndex&) { return core::diattenuator(.1, .1); });
  std::string text = csv_text(stored);
  text.erase(text.find("BRDF,0,0,90,0"), text.find("BRDF,0,0,90,60") - text.find("BRDF,0,0,90,0"));
  const TableCheck check = check_table(text, "c.csv");
  ASSERT_EQ(check.faults.size(), 1u);
  EXPECT_THAT(check.faults[0].to_string(), HasSubstr("got none for BRDF psi 0 sigma 0 phi 90 theta 0 lambda 550"));
}

TEST(TableSymmetry, TheDataAreReciprocalWithinTheInterpolation) {
  const BsdfTable table = BsdfTable::read(data_file("dbef.csv"));
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    const Agreement found = reciprocity(table, kind);
    EXPECT_GT(found.pairs, 2000u);
    EXPECT_LT(found.mean_difference, 0.01);
    EXPECT_LT(mirror_symmetry(table, kind).mean_difference, 1e-12);
  }
}

constexpr const char* kHeader =
    "# degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";

TEST(TableCheck, ATableOfZerosHasThatFaultAlone) {
  const auto black = [](Lines& l) { scale_rows(l, 0.0, [](const Lines&) { return true; }); };
  EXPECT_EQ(faults_with(black), "film.csv: must reflect or transmit, tau is 0 everywhere\n");
  const auto totals = HemisphericalTable::read(data_file("dbef_hemispherical.csv"));
  TableCheckOptions options;
  options.hemispherical = &totals;
  EXPECT_EQ(faults_with(black, options), "film.csv: must reflect or transmit, tau is 0 everywhere\n");
  const TableCheck one = check_table(std::string(kHeader) + "BRDF,0,0,0,0,550,0,0,0\n", "one.csv");
  ASSERT_EQ(one.faults.size(), 1u);
  EXPECT_EQ(one.faults[0].to_string(), "one.csv: must reflect or transmit, tau is 0 everywhere");
  EXPECT_TRUE(one.readable);
}

TEST(TableCheck, DarkPairsDoNotCountAsDeviation) {
  const TableCheck dark =
      check_with([](Lines& l) { scale_rows(l, 0.0, [](const Lines& e) { return e[0] == "BTDF"; }); });
  EXPECT_THAT(dark.faults, IsEmpty());
  for (const std::string& remark : dark.remarks) EXPECT_THAT(remark, testing::Not(HasSubstr("mirrored")));
  const TableCheck one =
      check_table(std::string(kHeader) + "BRDF,0,0,0,0,550,0.1,0.2,0\nBTDF,0,0,0,0,550,0,0,0\n", "one.csv");
  EXPECT_THAT(one.faults, IsEmpty());
}

TEST(TableCheck, TellsWhatCannotBeReadFromABadTable) {
  EXPECT_FALSE(check_table("", "film.csv").readable);
  EXPECT_FALSE(check_table(std::string_view("\x00\x01\x02,", 4), "film.csv").readable);
  EXPECT_FALSE(check_table("no HDF5", "film.h5").readable);
  EXPECT_TRUE(check_table("not a table\n", "film.csv").readable);
  EXPECT_TRUE(check_with([](Lines& l) { l.resize(100); }).readable);
}

}  // namespace
}  // namespace evenglow::tracer
