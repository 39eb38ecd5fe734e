#include "core/dots/dot_csv.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;

TEST(DotCsv, ReadsColumnsInAnyOrderAndTurnsUnits) {
  const DotPattern dots = parse_dot_csv("# dots\ndiameter_um,y_mm,x_mm,angle_deg\n60,2,1.5,90\n40,-1,0,0\n", "d.csv");
  ASSERT_EQ(dots.size(), 2u);
  EXPECT_EQ(dots[0].x, 1.5);
  EXPECT_EQ(dots[0].y, 2.0);
  EXPECT_FLOAT_EQ(dots[0].radius, 0.03f);
  EXPECT_FLOAT_EQ(dots[0].angle, 1.57079633f);
  EXPECT_FLOAT_EQ(dots[1].radius, 0.02f);
}

TEST(DotCsv, NeedsNoAngle) {
  EXPECT_EQ(parse_dot_csv("x_mm,y_mm,diameter_um\n1,2,60\n", "d.csv")[0].angle, 0.0f);
}

TEST(DotCsv, TellsThePlaceOfAFault) {
  const auto fault_of = [](const char* text) {
    try {
      parse_dot_csv(text, "d.csv");
    } catch (const ConfigError& error) {
      return error.faults()[0].to_string();
    }
    return std::string("none");
  };
  EXPECT_THAT(fault_of("x_mm,y_mm,diameter_um\n1,2,60\n1,2,-3\n"), HasSubstr("d.csv:3:5: diameter_um"));
  EXPECT_THAT(fault_of("x_mm,y_mm\n1,2\n"), HasSubstr("diameter_um"));
  EXPECT_THAT(fault_of("x_mm,y_mm,diameter_um\n"), HasSubstr("d.csv"));
  EXPECT_THAT(fault_of("x_mm,y_mm,diameter_um\n1,x,3\n"), HasSubstr("d.csv:2:3"));
}

}  // namespace
}  // namespace evenglow::core
