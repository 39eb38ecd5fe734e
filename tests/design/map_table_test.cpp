#include "design/problem/map_table.h"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/report/cairo_drawing.h"
#include "tests/support/program.h"

namespace evenglow::design {
namespace {

using testing::HasSubstr;

class MapTableFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  std::string refusal(const std::string& text) {
    try {
      read_map_csv(file("map.csv", text), {0.0, 1.0, "a density in [0, 1]"});
    } catch (const core::ConfigError& error) {
      return error.faults().front().to_string();
    }
    return "";
  }
  tests::TempFolder folder_;
};

TEST_F(MapTableFile, ReadsRowsFromTheLowest) {
  const MapTable map = read_map_csv(file("map.csv", "# comment\n0.1, 0.2,0.3\r\n0.4,0.5,0.6\n"), {0, 1, "a density"});
  EXPECT_EQ(map.nx, 3);
  EXPECT_EQ(map.ny, 2);
  EXPECT_EQ(map.values, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
}

TEST_F(MapTableFile, RefusesWithPlaceWhatIsNoMap) {
  EXPECT_THAT(refusal("0.1,0.2\n0.3,x\n"), HasSubstr("map.csv:2:5: must be a density in [0, 1], got"));
  EXPECT_THAT(refusal("0.1,1.5\n"), HasSubstr("map.csv:1:5: must be a density in [0, 1]"));
  EXPECT_THAT(refusal("0.1,nan\n"), HasSubstr("must be a density"));
  EXPECT_THAT(refusal("0.1,0.2\n0.3\n"), HasSubstr("must have 2 entries as the first row, got 1"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("must hold a matrix of numbers, got none"));
}

TEST_F(MapTableFile, StretchesOverAnyCells) {
  const MapTable map{2, 1, {1.0, 3.0}};
  const core::CellField fine = map.over(core::CellGrid::over(4, 2, 10, 20, 50, 30));
  EXPECT_EQ(fine.values, (std::vector<double>{1, 1.5, 2.5, 3, 1, 1.5, 2.5, 3}));
  EXPECT_EQ(map.over(core::CellGrid::over(1, 1, 0, 0, 1, 1)).values, (std::vector<double>{2.0}));
}

TEST_F(MapTableFile, ReadsAPictureFromItsLowestRow) {
  CairoDrawing drawing(20, 10);  // white
  drawing.cells({0, 0, 20, 5}, 1, 1, {Rgb{}});
  const auto path = folder_.path() / "map.png";
  drawing.save(path);
  const Rgb top = drawing.pixel(10, 2);
  const MapTable map = read_map_png(path);
  EXPECT_EQ(map.nx, 20);
  EXPECT_EQ(map.ny, 10);
  EXPECT_NEAR(map.values[10], 1.0, 1e-12) << "the lowest row is white";
  EXPECT_NEAR(map.values[8 * 20 + 10], (top.red + top.green + top.blue) / 3.0, 1e-9);
  EXPECT_LT(map.values[8 * 20 + 10], 1.0);
}

TEST_F(MapTableFile, RefusesWhatIsNoPictureAndHugeOnes) {
  EXPECT_THROW(read_map_png(file("a.png", "no picture")), core::ConfigError);
  std::string huge("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff", 24);
  EXPECT_THROW(read_map_png(file("b.png", huge)), core::ConfigError);
  std::string cut("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x10", 24);
  EXPECT_THROW(read_map_png(file("c.png", cut)), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::design
