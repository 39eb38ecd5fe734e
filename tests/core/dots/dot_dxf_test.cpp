#include "core/dots/dot_dxf.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;

std::string drawing(const std::string& entities, const std::string& before = "") {
  return before + "0\nSECTION\n2\nENTITIES\n" + entities + "0\nENDSEC\n0\nEOF\n";
}

std::string fault_of(const std::string& text) {
  try {
    parse_dot_dxf(text, "d.dxf");
  } catch (const ConfigError& error) {
    return error.faults()[0].to_string();
  }
  return "none";
}

constexpr const char* kCircle = "  0\r\nCIRCLE\r\n  8\r\nDOTS\r\n 10\r\n1.5\r\n 20\r\n-2\r\n 40\r\n0.03\r\n";

TEST(DotDxf, ReadsCirclesAndCountsOtherEntities) {
  const DxfDots found = parse_dot_dxf(drawing(std::string(kCircle) + "0\nLINE\n10\n0\n20\n0\n11\n1\n21\n1\n"), "d.dxf");
  ASSERT_EQ(found.dots.size(), 1u);
  EXPECT_EQ(found.dots[0], (Dot{1.5, -2.0, 0.03f, 0.0f}));
  EXPECT_EQ(found.ignored, 1u);
}

TEST(DotDxf, FollowsTheUnitOfTheHeader) {
  const std::string header = "0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n1\n0\nENDSEC\n";
  const DxfDots found = parse_dot_dxf(drawing("0\nCIRCLE\n10\n1\n20\n2\n40\n0.001\n", header), "d.dxf");
  EXPECT_DOUBLE_EQ(found.dots[0].x, 25.4);
  EXPECT_FLOAT_EQ(found.dots[0].radius, 0.0254f);
}

TEST(DotDxf, PlacesBlocksTurnedAndScaled) {
  const std::string blocks =
      "0\nSECTION\n2\nBLOCKS\n0\nBLOCK\n2\nD\n10\n1\n20\n0\n0\nCIRCLE\n10\n2\n20\n0\n40\n0.1\n0\nENDBLK\n0\nENDSEC\n";
  const DxfDots found =
      parse_dot_dxf(drawing("0\nINSERT\n2\nD\n10\n5\n20\n6\n41\n2\n42\n2\n50\n90\n", blocks), "d.dxf");
  ASSERT_EQ(found.dots.size(), 1u);
  EXPECT_NEAR(found.dots[0].x, 5.0, 1e-12);
  EXPECT_NEAR(found.dots[0].y, 8.0, 1e-12);
  EXPECT_FLOAT_EQ(found.dots[0].radius, 0.2f);
}

TEST(DotDxf, RefusesInOneLine) {
  EXPECT_THAT(fault_of("hello\nworld\n"), HasSubstr("d.dxf:1: must be a group code"));
  EXPECT_THAT(fault_of(drawing("0\nLINE\n10\n1\n")), HasSubstr("at least one circle, got none among 1"));
  EXPECT_THAT(fault_of(drawing("0\nCIRCLE\n10\nx\n")), HasSubstr("d.dxf:8: must be a number"));
  EXPECT_THAT(fault_of(drawing("0\nCIRCLE\n10\n1\n20\n1\n")), HasSubstr("radius above 0"));
  EXPECT_THAT(fault_of(drawing("0\nINSERT\n2\nnone\n10\n1\n")), HasSubstr("must name a block"));
  EXPECT_THAT(fault_of(""), HasSubstr("at least one circle"));
  EXPECT_THAT(fault_of("0\nSECTION\n2"), HasSubstr("end of the file"));
}

}  // namespace
}  // namespace evenglow::core
