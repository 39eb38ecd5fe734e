#include "tracer/scene/dots_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/scenes.h"
#include "tests/support/temp_folder.h"
#include "tracer/microstructure/dot_grid.h"
#include "tracer/scene/density_field.h"

namespace evenglow::tests {
namespace {

using testing::HasSubstr;

class DotsFile : public testing::Test {
 protected:
  std::string backlight(const std::string& dots, const std::string& more = "", const std::string& file = "dots.csv",
                        const std::string& plate = "") {
    write_text(folder_ / file, dots);
    return "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 1" + plate +
           "}, sources: [{kind: led_row, count: 2}], microstructure: {cells: [4, 2], dots_file: \"" +
           (folder_ / file).string() + "\"" + more + "}";
  }
  std::string fault(const std::string& text) {
    try {
      backlight_of(text);
    } catch (const core::ConfigError& error) {
      return error.what();
    }
    return "accepted";
  }
  TempFolder folder_;
};

const char* const kHead = "x_mm,y_mm,diameter_um\n";

TEST_F(DotsFile, TheDensityBecomesThePatternWithItsCoverage) {
  const auto spec = backlight_of(backlight(std::string(kHead) + "2.5,2.5,1000\n12.5,7.5,2000\n"));
  ASSERT_TRUE(spec.microstructure->dots);
  const tracer::DensityField density = tracer::initial_density(spec);
  ASSERT_TRUE(density.dots);
  EXPECT_EQ(density.dots->size(), 2U);
  EXPECT_EQ(density.at(12.5, 8.4), 1.0);
  EXPECT_EQ(density.at(12.5, 8.6), 0.0);
  EXPECT_NEAR(density.cells.values[0], 0.25 * 3.14159265 / 25.0, 1e-8);
  EXPECT_NEAR(density.cells.values[6], 3.14159265 / 25.0, 1e-8);
  EXPECT_EQ(density.cells.values[1], 0.0);
}

TEST_F(DotsFile, SquaresAndDrawings) {
  const auto squares = backlight_of(backlight(std::string(kHead) + "5,5,2000\n", ", footprint: square"));
  EXPECT_TRUE(squares.microstructure->dots->covers(5.9, 5.9));
  const std::string drawing = "0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n10\n5\n20\n6\n40\n0.5\n0\nENDSEC\n0\nEOF\n";
  const auto read = backlight_of(backlight(drawing, "", "dots.DXF"));
  EXPECT_TRUE(read.microstructure->dots->covers(5.3, 6.3));
}

TEST_F(DotsFile, FaultsAreOneLineWithTheirPlace) {
  const std::string one = std::string(kHead) + "5,5,2000\n";
  EXPECT_THAT(fault(backlight(std::string(kHead) + "5,5,2000\n19.5,5,2000\n")),
              testing::AllOf(HasSubstr("dots must lie on the face, x 0 to 20 and y 0 to 10 mm, got dot 2 of 2000 um"),
                             HasSubstr("(19.5, 5) mm"), HasSubstr("dots.csv")));
  EXPECT_EQ(fault(backlight(one, ", density: 0.3")), "accepted");  // of the run file that designed it
  EXPECT_THAT(fault(backlight(one, ", density_file: \"" + (folder_ / "dots.csv").string() + "\"")),
              HasSubstr("density_file: must be left out"));
  EXPECT_THAT(fault(backlight(one, ", kind: v_groove")), HasSubstr("which has no ends"));
  EXPECT_THAT(fault(backlight(one, ", kind: cone, footprint: square")), HasSubstr("footprint: must be round for"));
  EXPECT_THAT(fault(backlight(one + "5.5,5,200\n", ", kind: cone")),
              HasSubstr("shapes with a height must not overlap, got dots 1 and 2"));
  EXPECT_EQ(fault(backlight(one + "5.5,5,200\n")), "accepted");  // ink may
  EXPECT_THAT(fault(backlight(one, ", kind: cone", "dots.csv", ", end_thickness_mm: 0.5")), HasSubstr("got a wedge"));
  EXPECT_THAT(fault(backlight(kHead)), HasSubstr("must hold at least one row"));
  EXPECT_THAT(fault("light_guide_plate: {}, sources: [{kind: led_row, count: 2}], microstructure: {footprint: round}"),
              HasSubstr("footprint: is for dots of a dots_file"));
}

}  // namespace
}  // namespace evenglow::tests
