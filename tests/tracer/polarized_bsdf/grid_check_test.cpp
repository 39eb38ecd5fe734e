#include "tracer/polarized_bsdf/grid_check.h"

#include <algorithm>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tracer/polarized_bsdf/bsdf_grid.h"
#include "core/config/csv_numbers.h"

namespace evenglow::tracer {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;
using Rows = std::vector<std::string>;

/// 2 sigma x 2 phi x 3 theta, theta fastest; line 2 is the first row.
Rows whole() {
  Rows rows;
  for (const int sigma : {0, 30}) {
    for (const int phi : {0, 90}) {
      for (const int theta : {0, 10, 20}) rows.push_back(fmt::format("BRDF,0,{},{},{},550", sigma, phi, theta));
    }
  }
  return rows;
}

std::vector<std::string> faults(const Rows& rows) {
  std::string text = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm,tau_min,tau_max,delta_deg\n";
  for (const std::string& row : rows) text += row + ",1,2,0\n";
  std::vector<std::string> lines;
  for (const core::Fault& fault : grid_faults(core::CsvNumbers::parse(text, "t.csv", bsdf_columns()))) {
    lines.push_back(fault.to_string());
  }
  return lines;
}

TEST(GridCheck, AFullGridHasNone) {
  EXPECT_THAT(faults(whole()), IsEmpty());
  Rows by_theta = whole();
  std::ranges::stable_sort(by_theta, {}, [](const std::string& row) { return row.substr(row.find(",550") - 2, 2); });
  EXPECT_THAT(faults(by_theta), IsEmpty()) << "any column may change slowest";
}

TEST(GridCheck, AMissingNodeIsNamedAtItsPlace) {
  Rows rows = whole();
  rows.erase(rows.begin() + 4);
  EXPECT_THAT(faults(rows), ElementsAre("t.csv:5:1: must hold every node of its grid, got none for BRDF psi 0 sigma 0 "
                                        "phi 90 theta 10 lambda 550"));
}

TEST(GridCheck, AFileThatEndsEarlyGetsOneLine) {
  Rows rows = whole();
  rows.resize(9);
  EXPECT_THAT(faults(rows),
              ElementsAre(HasSubstr("t.csv:10:1: must hold every node of its grid, got a file that ends 3 "
                                    "nodes early (truncated?)")));
}

TEST(GridCheck, ARepeatedRowNamesTheFirst) {
  Rows rows = whole();
  rows.insert(rows.begin() + 6, rows[2]);
  EXPECT_THAT(faults(rows), ElementsAre("t.csv:8:1: must hold each node once, got BRDF psi 0 sigma 0 phi 0 theta 20 "
                                        "lambda 550 again (first on line 4)"));
}

TEST(GridCheck, RowsOutOfOrder) {
  Rows rows = whole();
  std::swap(rows[3], rows[8]);
  EXPECT_THAT(faults(rows), ElementsAre(HasSubstr("rows must be in the order of the grid, got BRDF")));
}

TEST(GridCheck, TellsTenAndHowManyMore) {
  Rows rows = whole();
  // A second kind with one node only: eleven are missing, in the middle of the order.
  rows.insert(rows.begin(), "BTDF,0,0,0,0,550");
  rows.push_back("BTDF,0,30,90,20,650");
  const auto found = faults(rows);
  EXPECT_EQ(std::ranges::count_if(found, [](const std::string& f) { return f.find("got none for B") != f.npos; }), 10);
  EXPECT_THAT(found,
              testing::Contains(testing::MatchesRegex("t.csv: must hold every node .* got none for [0-9]+ more")));
}

TEST(GridCheck, ScatteredPointsEndInTime) {
  Rows rows;
  for (int i = 0; i < 60; ++i) rows.push_back(fmt::format("BRDF,{0},{0},{0},{0},{1}", i, 400 + i));
  EXPECT_THAT(faults(rows), testing::Not(IsEmpty()));
}

}  // namespace
}  // namespace evenglow::tracer
