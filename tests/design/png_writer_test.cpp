#include "design/report/png_writer.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/report/cairo_drawing.h"
#include "design/report/map_plot.h"
#include "tests/design/metrology_samples.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

struct PngHeader {
  bool signed_right = false;
  unsigned width = 0;
  unsigned height = 0;
};

PngHeader header(const std::string& png) {
  const auto number = [&](std::size_t at) {
    unsigned value = 0;
    for (std::size_t i = 0; i < 4; ++i) value = value << 8U | static_cast<unsigned char>(png.at(at + i));
    return value;
  };
  return {png.substr(0, 8) == "\x89PNG\r\n\x1a\n" && png.substr(12, 4) == "IHDR", number(16), number(20)};
}

/// A PNG of this size without any mark is far smaller than one with a map or curves on it.
void expect_picture(const std::filesystem::path& path, unsigned width, const samples::Folder& folder) {
  const std::string png = samples::content(path);
  ASSERT_GT(png.size(), 33U) << path;
  const PngHeader head = header(png);
  EXPECT_TRUE(head.signed_right);
  EXPECT_NEAR(head.width, width, 1.0);
  EXPECT_GT(head.height, 200U);
  CairoDrawing(static_cast<int>(head.width), static_cast<int>(head.height)).save(folder.path() / "blank.png");
  EXPECT_GT(png.size(), samples::content(folder.path() / "blank.png").size() + 4000U) << path;
}

TEST(PngWriter, WritesThreePicturesOfARun) {
  const samples::Folder folder("png");
  PngWriter().write(samples::report(), folder.path());
  for (const char* name : {"luminance.png", "density.png", "convergence.png"}) {
    expect_picture(folder.path() / name, 1600, folder);
  }
}

TEST(PngWriter, PutsVariantsSideBySide) {
  const samples::Folder folder("png_compare");
  const auto width = [&](std::vector<Report> variants) {
    PngWriter().write(compare_reports("t", "c", std::move(variants)), folder.path());
    return header(samples::content(folder.path() / "compare.png")).width;
  };
  const unsigned two = width({samples::report("a"), samples::report("b")});
  const unsigned three = width({samples::report("a"), samples::report("b"), samples::report("c")});
  EXPECT_NEAR(three - two, 760.0, 1.0);
}

TEST(PngWriter, DrawsWhateverTheNumbers) {
  const samples::Folder folder("png_odd");
  Report r = samples::report();
  r.title = "ill-formed \xff <b>";
  r.luminance = core::CellField(r.luminance.grid, 5.0);
  r.luminance.values[3] = std::numeric_limits<double>::quiet_NaN();
  r.density = {};
  r.steps.resize(1);
  r.steps[0].rms = 0.0;
  r.steps[0].rms_corrected = {-0.01, std::numeric_limits<double>::quiet_NaN()};
  r.final.rms_corrected = {0.0, std::numeric_limits<double>::infinity()};
  PngWriter().write(r, folder.path());
  PngWriter().write(Report{}, folder.path());
  PngWriter().write(compare_reports("", "", {r, Report{}}), folder.path());
  EXPECT_TRUE(header(samples::content(folder.path() / "compare.png")).signed_right);
}

/// A map five times as high as wide is narrower than its caption: the picture is not, so that nothing is cut off.
TEST(PngWriter, TallMapsLeaveRoomForTheirCaption) {
  const samples::Folder folder("png_tall");
  Report tall = samples::report_with_metrology();
  tall.color->delta = core::CellField({4, 20, 0.0, 0.0, 5.0, 5.0}, 0.002);
  tall.color->delta_se = core::CellField(tall.color->delta.grid, 0.0004);
  PngWriter().write(tall, folder.path());
  const MapPlot shortest{"",
                         "from the mean color; RMS 0.002 (noise taken off); standard error of a cell 0.0004",
                         &tall.color->delta,
                         {0.0, 1.0},
                         &ColorMap::luminance()};
  EXPECT_GT(header(samples::content(folder.path() / "delta_uv.png")).width,
            caption_right(CairoDrawing(1, 1), shortest, 26.0));
}

TEST(PngWriter, NamesThePathItCannotWrite) {
  try {
    PngWriter().write(samples::report(), "/nowhere/at/all");
    FAIL() << "wrote into a folder that is not there";
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("/nowhere/at/all/luminance.png"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace evenglow::design
