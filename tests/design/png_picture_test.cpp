#include <fstream>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/config/matrix_file.h"
#include "design/report/cairo_drawing.h"
#include "tests/support/program.h"

/// Pictures as numbers; in the tests of the floor that can draw them.
namespace evenglow::design {
namespace {

class PngPicture : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) {
    std::ofstream(folder_.path() / name, std::ios::binary) << text;
    return folder_.path() / name;
  }
  tests::TempFolder folder_;
};

TEST_F(PngPicture, ReadsAPictureFromItsLowestRow) {
  CairoDrawing drawing(20, 10);  // white
  drawing.cells({0, 0, 20, 5}, 1, 1, {Rgb{}});
  const auto path = folder_.path() / "map.png";
  drawing.save(path);
  const Rgb top = drawing.pixel(10, 2);
  const core::NumberMatrix map = core::read_png_picture(path);
  EXPECT_EQ(map.nx, 20);
  EXPECT_EQ(map.ny, 10);
  EXPECT_NEAR(map.values[10], 1.0, 1e-12) << "the lowest row is white";
  EXPECT_NEAR(map.values[8 * 20 + 10], (top.red + top.green + top.blue) / 3.0, 1e-9);
  EXPECT_LT(map.values[8 * 20 + 10], 1.0);
}

TEST_F(PngPicture, RefusesWhatIsNoPictureAndHugeOnes) {
  EXPECT_THROW(core::read_png_picture(file("a.png", "no picture")), core::ConfigError);
  std::string huge("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\x7f\xff\xff\xff\x7f\xff\xff\xff", 24);
  EXPECT_THROW(core::read_png_picture(file("b.png", huge)), core::ConfigError);
  std::string cut("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x10\0\0\0\x10", 24);
  EXPECT_THROW(core::read_png_picture(file("c.png", cut)), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::design
