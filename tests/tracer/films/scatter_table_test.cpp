#include "tracer/films/scatter_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

using core::kRadPerDeg;
using ::testing::HasSubstr;

std::string fault_of(const std::string& text) {
  try {
    parse_scatter_table(text, "t.csv");
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(ScatterTable, ReadsRowsInAnyOrder) {
  const BsdfTable table = parse_scatter_table(
      "# 1/sr\nbtdf,incidence_deg,theta_deg,brdf\n"
      "3,0,0,0.3\n1,0,40,0.1\n0.5,60,40,0.05\n2,60,0,0.2\n",
      "t.csv");
  const auto at = [&](ScatterKind kind, double sigma, double theta) {
    return table.at(kind, 0.3, sigma * kRadPerDeg, 1.0, theta * kRadPerDeg, 550.0);
  };
  // S is twice the value for natural light, and all polarizations are alike.
  EXPECT_NEAR(at(ScatterKind::transmission, 0, 0).S, 6.0, 1e-9);
  EXPECT_NEAR(at(ScatterKind::transmission, 60, 40).S, 1.0, 1e-9);
  EXPECT_NEAR(at(ScatterKind::reflection, 60, 0).S, 0.4, 1e-9);
  EXPECT_EQ(at(ScatterKind::reflection, 60, 0).x, 0.0);
}

TEST(ScatterTable, IsMirroredInThePlaneOfIncidence) {
  const BsdfTable table = parse_scatter_table(
      "incidence_deg,theta_deg,phi_deg,btdf\n"
      "0,0,0,2\n0,0,90,2\n0,0,180,2\n0,30,0,1\n0,30,90,0.9\n0,30,180,0.25\n",
      "t.csv");
  EXPECT_FALSE(table.has(ScatterKind::reflection));
  const auto at = [&](double phi) {
    return table.at(ScatterKind::transmission, 0, 0, phi * kRadPerDeg, 30 * kRadPerDeg, 550).S;
  };
  EXPECT_NEAR(at(270), 1.8, 1e-9);
  EXPECT_NEAR(at(180), 0.5, 1e-9);
  for (const double phi : {20.0, 70.0, 130.0}) EXPECT_NEAR(at(phi), at(360 - phi), 1e-9);
}

TEST(ScatterTable, RefusesInOneLine) {
  EXPECT_THAT(fault_of("incidence_deg,theta_deg\n0,0\n"), HasSubstr("must have a column brdf or btdf"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,btdf\n0,0,0\n"), HasSubstr("values above 0, got none"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,btdf\n0,0,1\n0,10,-1\n"), HasSubstr("t.csv:3"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,btdf\n0,0,1\n0,0,2\n"), HasSubstr("each direction once"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,btdf\n0,0,1\n0,10,1\n30,0,1\n"),
              HasSubstr("no row for incidence_deg 30, theta_deg 10"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,phi_deg,btdf\n0,0,270,1\n"), HasSubstr("[0, 180]"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,phi_deg,btdf\n0,0,0,1\n0,0,0.001,1\n"),
              HasSubstr("must have steps of at least 0.01, got 0 and 0.001"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,brightness\n0,0,1\n"), HasSubstr("brightness"));
  EXPECT_THAT(fault_of("incidence_deg,theta_deg,btdf\n90,0,1\n"), HasSubstr("[0, 90)"));
}

/// Points on a diagonal would make a grid of the square of their number.
TEST(ScatterTable, ScatteredRowsCostNoMemory) {
  std::string text = "incidence_deg,theta_deg,btdf\n";
  for (int i = 0; i < 20000; ++i) {
    text += std::to_string(i * 0.004) + "," + std::to_string(i * 0.008) + ",1\n";
  }
  EXPECT_THAT(fault_of(text), HasSubstr("must be a full grid of 20000 incidences x 20000 theta x 1 phi"));
  text = "incidence_deg,theta_deg,phi_deg,btdf\n";
  for (int i = 0; i < 9000; ++i) text += "0,0," + std::to_string(i * 0.02) + ",1\n";
  EXPECT_THAT(fault_of(text), HasSubstr("must have at most 361 values, got 9000"));
}

}  // namespace
}  // namespace evenglow::tracer
