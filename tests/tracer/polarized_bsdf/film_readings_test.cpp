#include "tracer/polarized_bsdf/film_readings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

using testing::HasSubstr;

constexpr const char* kUnits = "# degrees, nm, 1/sr\n";
constexpr const char* kNode = "kind,psi_deg,sigma_deg,phi_deg,theta_deg,lambda_nm";

FilmReadings four(const std::string& columns, const std::string& rows) {
  return FilmReadings::parse(std::string(kUnits) + kNode + columns + "\n" + rows, "r.csv");
}
FilmReadings general(const std::string& rows) {
  return four(",in_kind,in_angle_deg,out_kind,out_angle_deg,value,se", rows);
}

template <typename Read>
std::string fault(Read&& read) {
  try {
    read();
  } catch (const core::ConfigError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(FilmReadings, FourAnglesOfANodeInTheOrderOfTheFile) {
  const auto readings = four(",b0,b45,b90,b135,se",
                             "BTDF,0,0,0,10,550,4,,2,3,0.1\nBRDF,0,0,0,10,550,1,2,3,4,0.2\n"
                             "BTDF,0,0,0,10,550,5,6,7,8,0.3\n");
  EXPECT_FALSE(readings.general());
  EXPECT_TRUE(readings.has_errors());
  ASSERT_EQ(readings.groups().size(), 2u);
  EXPECT_EQ(readings.groups()[0].node.kind, ScatterKind::reflection) << "nodes ascend";
  const ReadingGroup& group = readings.groups()[1];
  EXPECT_EQ(group.node.to_string(), "BTDF psi 0 sigma 0 phi 0 theta 10 lambda 550");
  ASSERT_EQ(group.readings.size(), 7u) << "two rows, one entry empty";
  EXPECT_EQ(group.readings[1].value, 2.0);
  EXPECT_NEAR(group.readings[1].in_angle, core::kPi / 2, 1e-12) << "b45 is missing";
  EXPECT_EQ(group.readings[1].in_kind, PolarizerKind::linear);
  EXPECT_EQ(group.readings[1].out_kind, PolarizerKind::none);
  EXPECT_EQ(group.readings[1].se, 0.1);
  EXPECT_EQ(group.readings[6].se, 0.3);
  EXPECT_EQ(group.readings[0].line, 3);
  EXPECT_EQ(group.readings[6].line, 5);
}

TEST(FilmReadings, EachReadingMayHaveItsOwnError) {
  const auto readings = four(",b0,b45,b90,b135,se0,se45,se90,se135", "BRDF,0,0,0,0,550,1,1,1,1,0.1,0.2,0.3,0.4\n");
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_NEAR(readings.groups()[0].readings[i].se, 0.1 * static_cast<double>(i + 1), 1e-15);
  }
}

TEST(FilmReadings, WithoutErrors) {
  const auto readings = four(",b0,b45,b90,b135", "BRDF,0,0,0,0,550,1,1,1,1\n");
  EXPECT_FALSE(readings.has_errors());
  EXPECT_EQ(readings.groups()[0].readings[0].se, 0.0);
}

TEST(FilmReadings, GeneralReadings) {
  const auto readings = general("BRDF,0,0,0,0,550,linear,30,right,,2.5,0.1\nBRDF,0,0,0,0,550,none,,left,77,1,0.1\n");
  EXPECT_TRUE(readings.general());
  ASSERT_EQ(readings.groups().size(), 1u);
  const FilmReading& first = readings.groups()[0].readings[0];
  EXPECT_EQ(first.in_kind, PolarizerKind::linear);
  EXPECT_NEAR(first.in_angle, core::kPi / 6, 1e-12);
  EXPECT_EQ(first.out_kind, PolarizerKind::right);
  EXPECT_EQ(first.value, 2.5);
  EXPECT_EQ(readings.groups()[0].readings[1].out_kind, PolarizerKind::left);
  EXPECT_EQ(readings.groups()[0].readings[1].in_kind, PolarizerKind::none);
}

TEST(FilmReadings, NamesFaults) {
  EXPECT_THAT(fault([] { FilmReadings::parse("# radians\na\n", "r.csv"); }), HasSubstr("got 'radians'"));
  EXPECT_THAT(
      fault([] { FilmReadings::parse(std::string(kNode) + ",b0,b45,b90,b135\nBRDF,0,0,0,0,550,1,1,1,1\n", "r.csv"); }),
      HasSubstr("r.csv:1:1: the comment must name the units degrees, nm and 1/sr on the first line, got none"));
  EXPECT_THAT(fault([] {
                FilmReadings::parse(std::string("# my film\n") + kNode + ",b0,b45,b90,b135\nBRDF,0,0,0,0,550,1,1,1,1\n",
                                    "r.csv");
              }),
              HasSubstr("got one without 1/sr"));
  EXPECT_THAT(fault([] { four(",b0,b45,b90,b135", "BRDF,0,0,0,0,550,1,,,1\n"); }), HasSubstr("r.csv:3:"));
  EXPECT_THAT(fault([] { four(",b0,b45,b90", "BRDF,0,0,0,0,550,1,1,1\n"); }), HasSubstr("b135"));
  EXPECT_THAT(fault([] { four(",b0,b45,b90,b135,se", "BRDF,0,0,0,0,550,1,1,1,1,-1\n"); }), HasSubstr("se"));
  EXPECT_THAT(fault([] { general("BRDF,0,0,0,0,550,linear,,none,,1,0.1\n"); }), HasSubstr("in_angle_deg"));
  EXPECT_THAT(fault([] { general("BRDF,0,0,0,0,550,elliptic,0,none,,1,0.1\n"); }), HasSubstr("in_kind"));
  EXPECT_THAT(fault([] { FilmReadings::read("/no/such/readings.csv"); }), HasSubstr("/no/such/readings.csv"));
}

}  // namespace
}  // namespace evenglow::tracer
