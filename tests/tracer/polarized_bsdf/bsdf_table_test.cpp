#include "tracer/polarized_bsdf/bsdf_table.h"

#include <algorithm>
#include <cmath>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/films.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;
using tests::data_file;
using tests::kRad;

constexpr const char* kHeader =
    "# units: degrees, nm, 1/sr\nkind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";

/// One kind, psi 0 and 90, theta 0 and 5 and 20: lines 3 to 8.
std::vector<std::string> small_rows() {
  return {"BRDF,0,0,0,0,550,1,3,0",  "BRDF,0,0,0,5,550,1,2,0",  "BRDF,0,0,0,20,550,0.5,0.5,0",
          "BRDF,90,0,0,0,550,1,3,0", "BRDF,90,0,0,5,550,1,2,0", "BRDF,90,0,0,20,550,0.5,0.5,0"};
}

std::string text_of(const std::vector<std::string>& rows) {
  std::string text = kHeader;
  for (const std::string& row : rows) text += row + "\n";
  return text;
}

std::string fault_of(const std::string& text) {
  try {
    BsdfTable::parse(text, "film.csv");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

std::string fault_with(std::size_t row, const std::string& line) {
  std::vector<std::string> rows = small_rows();
  rows[row] = line;
  return fault_of(text_of(rows));
}

TEST(BsdfTable, ReadsTheDataFile) {
  const BsdfTable table = BsdfTable::read(data_file("dbef.csv"));
  EXPECT_EQ(table.axes().psi.size(), 4u);
  EXPECT_EQ(table.axes().sigma.size(), 6u);
  EXPECT_EQ(table.axes().phi.size(), 8u);
  EXPECT_EQ(table.axes().theta.size(), 17u);
  EXPECT_EQ(table.axes().lambda_nm, std::vector<double>{550.0});
  const BsdfTable::Node& node = table.node(ScatterKind::reflection, 0, 0, 0, 2, 0);
  EXPECT_EQ(node.tau_min, 0.72146);
  EXPECT_EQ(node.tau_max, 13.568);
  EXPECT_EQ(node.kappa, 1.0);
}

TEST(BsdfTable, IsExactAtEveryNode) {
  const BsdfTable table = BsdfTable::read(data_file("dbef.csv"));
  const auto& a = table.axes();
  for (const ScatterKind kind : {ScatterKind::reflection, ScatterKind::transmission}) {
    for (std::size_t p = 0; p < a.psi.size(); ++p) {
      for (std::size_t s = 0; s < a.sigma.size(); ++s) {
        for (std::size_t f = 0; f < a.phi.size(); ++f) {
          for (std::size_t t = 0; t < a.theta.size(); ++t) {
            const BsdfTable::Node& node = table.node(kind, p, s, f, t, 0);
            const auto value = table.at(kind, a.psi[p], a.sigma[s], a.phi[f], a.theta[t], 550.0);
            const double S = node.tau_min + node.tau_max;
            ASSERT_NEAR(value.S, S, 1e-9 * S);
            ASSERT_NEAR(value.S * value.x, (node.tau_max - node.tau_min) * std::cos(2.0 * node.delta), 1e-9 * S);
            ASSERT_NEAR(value.S * value.y, (node.tau_max - node.tau_min) * std::sin(2.0 * node.delta), 1e-9 * S);
          }
        }
      }
    }
  }
}

TEST(BsdfTable, RowOrderAndColumnOrderDoNotMatter) {
  std::vector<std::string> rows = small_rows();
  std::reverse(rows.begin(), rows.end());
  const BsdfTable one = BsdfTable::parse(text_of(small_rows()), "a");
  const BsdfTable two = BsdfTable::parse(text_of(rows), "b");
  const BsdfTable three = BsdfTable::parse(
      "lambda_nm, kind, delta_deg, psi_deg, sigma_deg, phi_deg, theta_deg, tau_max, tau_min, kappa\r\n"
      "550, BRDF, 0, 0, 0, 0, 0, 3, 1, 0.5\r\n\r\n",
      "c");
  EXPECT_EQ(one.at(ScatterKind::reflection, 0.3, 0, 0.1, 0.1, 550).S,
            two.at(ScatterKind::reflection, 0.3, 0, 0.1, 0.1, 550).S);
  EXPECT_NEAR(three.at(ScatterKind::reflection, 1, 1, 1, 1, 1).S, 4.0, 1e-12);
  EXPECT_EQ(three.at(ScatterKind::reflection, 1, 1, 1, 1, 1).kappa, 0.5);
  EXPECT_EQ(three.at(ScatterKind::transmission, 1, 1, 1, 1, 1).S, 0.0);
}

TEST(BsdfTable, InterpolatesAsTheDataSay) {
  const BsdfTable table = BsdfTable::parse(text_of(small_rows()), "a");
  const auto at = [&](double theta) { return table.at(ScatterKind::reflection, 0.2, 0.0, 0.0, theta * kRad, 550.0); };
  EXPECT_NEAR(at(5.0 / std::sqrt(2.0)).S, std::sqrt(4.0 * 3.0), 1e-9) << "ln S linear in theta^2 below 10 degrees";
  EXPECT_NEAR(at(12.5).S, std::sqrt(3.0 * 1.0), 1e-9) << "ln S linear in theta above";
  EXPECT_NEAR(at(12.5).x, 0.5 / 3.0, 1e-9);
  EXPECT_NEAR(at(27.5).S, 1.0 / std::sqrt(3.0), 1e-9) << "goes on with the last slope";
}

TEST(BsdfTable, IsPeriodicInPsiAndPhi) {
  const BsdfTable table = BsdfTable::read(data_file("dbef.csv"));
  const auto S = [&](double psi, double phi) {
    return table.at(ScatterKind::reflection, psi * kRad, 0.5, phi * kRad, 0.1, 550.0).S;
  };
  EXPECT_NEAR(S(170, 350), S(-10, -10), 1e-12 * S(170, 350));
  EXPECT_NEAR(S(179.9999, 20), S(0.0001, 20), 1e-4 * S(0, 20));
  EXPECT_NEAR(S(30, 359.9999), S(30, 0.0001), 1e-4 * S(30, 0));
}

TEST(BsdfTable, IsLinearInWavelengthAndHeldBeyond) {
  const BsdfTable table =
      BsdfTable::parse(std::string(kHeader) + "BTDF,0,0,0,0,450,1,1,0\nBTDF,0,0,0,0,650,4,4,0\n", "a");
  EXPECT_NEAR(table.at(ScatterKind::transmission, 0, 0, 0, 0, 550).S, 4.0, 1e-12);
  EXPECT_NEAR(table.at(ScatterKind::transmission, 0, 0, 0, 0, 700).S, 8.0, 1e-12);
}

TEST(BsdfTable, NamesEachFaultWithItsPlace) {
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,x,2,0"),
              HasSubstr("film.csv:4:18: tau_min: must be a number in [0, 1e12], got 'x'"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,nan,2,0"), HasSubstr("film.csv:4:18: tau_min"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,1,inf,0"), HasSubstr("film.csv:4:20: tau_max"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,-1,2,0"), HasSubstr("got '-1'"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,1 2,2,0"), HasSubstr("got '1 2'"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,,2,0"), HasSubstr("got ''"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,1e999,2,0"), HasSubstr("got '1e999'"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,550,3,2,0"),
              HasSubstr("film.csv:4:18: tau_min: must be at most tau_max = 2, got 3"));
  EXPECT_THAT(fault_with(1, "BSDF,0,0,0,5,550,1,2,0"),
              HasSubstr("film.csv:4:1: kind: must be BRDF or BTDF, got 'BSDF'"));
  EXPECT_THAT(fault_with(1, "BRDF,180,0,0,5,550,1,2,0"), HasSubstr("psi_deg: must be a number in [0, 180), got '180'"));
  EXPECT_THAT(fault_with(1, "BRDF,0,90,0,5,550,1,2,0"), HasSubstr("sigma_deg"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,5,0,1,2,0"), HasSubstr("lambda_nm"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,0,550,1,3,0"), HasSubstr("film.csv:4:1: must hold each node once"));
  EXPECT_THAT(fault_with(5, "BRDF,90,0,0,5,550,1,3,0"), HasSubstr("film.csv:8:1: must hold each node once"));
  EXPECT_THAT(fault_with(1, "BRDF,0,0,0,6,550,1,2,0"),
              HasSubstr("must hold every node of its grid, got none for BRDF psi 0 sigma 0 phi 0 theta 5"));
  EXPECT_THAT(fault_with(5, "BRDF,90,0,0"),
              HasSubstr("film.csv:8:1: must have 9 entries as the header (line 2), got 4"));
}

TEST(BsdfTable, RefusesWhatIsNoTable) {
  std::vector<std::string> rows = small_rows();
  rows.pop_back();
  EXPECT_THAT(fault_of(text_of(rows)), HasSubstr("got none for BRDF psi 90 sigma 0 phi 0 theta 20"));
  rows = small_rows();
  rows.push_back("BTDF,0,0,0,0,550,1,3,0");
  EXPECT_THAT(fault_of(text_of(rows)), HasSubstr("got none for BTDF"));
  rows = small_rows();
  rows.push_back(rows.back());
  EXPECT_THAT(fault_of(text_of(rows)), HasSubstr("film.csv:9:1: must hold each node once"));
  EXPECT_THAT(fault_of(""), HasSubstr("film.csv: must be a CSV table, got an empty file"));
  EXPECT_THAT(fault_of("# only a comment\n"), HasSubstr("empty"));
  EXPECT_THAT(fault_of(kHeader), HasSubstr("at least one row"));
  EXPECT_THAT(fault_of("\x89PNG\r\n\x1a\n\0\0\0"), HasSubstr("film.csv:1:1: columns must be kind,psi_deg"));
  EXPECT_THAT(fault_of("kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max\n"),
              HasSubstr("film.csv:1:1: delta_deg: is a required column"));
  EXPECT_THAT(fault_of("kind,psi_deg,psi_deg\n"), HasSubstr("film.csv:1:14: psi_deg: must be named once"));
  EXPECT_THROW(BsdfTable::read("/no/such/table.csv"), core::ConfigError);
  EXPECT_THROW(BsdfTable::read("/"), core::ConfigError);
}

TEST(BsdfTable, RefusesOtherUnitsAndTakesNone) {
  const std::string text = text_of(small_rows());
  const std::string rows = text.substr(text.find('\n') + 1);
  EXPECT_THAT(fault_of("# radians, nm, 1/sr\n" + rows), HasSubstr("film.csv:1:1: the comment must name the units"));
  EXPECT_THAT(fault_of("# degrees, mm, cd/m2\n" + rows), HasSubstr("got 'cd/m2'"));
  EXPECT_EQ(fault_of(rows), "accepted");
  EXPECT_EQ(fault_of("# my film\n" + rows), "accepted");
}

TEST(BsdfTable, RefusesFilesAbove256MB) {
  const std::string path = testing::TempDir() + "/evenglow_large_table.csv";
  std::ofstream(path) << "kind\n";
  std::filesystem::resize_file(path, (256ull << 20) + 1);  // sparse: takes no room
  try {
    BsdfTable::read(path);
    ADD_FAILURE() << "accepted";
  } catch (const core::ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("must not be larger than 256 MiB"));
  }
  std::filesystem::remove(path);
}

TEST(BsdfTable, TellsManyFaultsAtOnceButNotAll) {
  std::vector<std::string> rows(1000, "BRDF,0,0,0,5,550,-1,2,0");
  try {
    BsdfTable::parse(text_of(rows), "film.csv");
    ADD_FAILURE() << "accepted";
  } catch (const core::ConfigError& error) {
    EXPECT_GE(error.faults().size(), 5u);
    EXPECT_LE(error.faults().size(), 20u);
  }
}

}  // namespace
}  // namespace evenglow::tracer
