#include "design/dots/dot_files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/dots/dot_csv.h"
#include "core/dots/dot_dxf.h"
#include "design/dots/gds_records.h"
#include "design/dots/streamed_file.h"
#include "tests/design/dots/dot_samples.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using namespace evenglow::design;
using ::testing::HasSubstr;

class DotFiles : public ::testing::Test {
 protected:
  DotFiles() {
    for (std::size_t i = 0; i < dots.size(); ++i) {
      dots[i].x = std::round(dots[i].x * 1e6) / 1e6;
      dots[i].y = std::round(dots[i].y * 1e6) / 1e6;
      if (i % 3 == 0) dots[i].radius = 0.02025f;
    }
  }
  DotSheet sheet(core::Footprint footprint = core::Footprint::round) const {
    return {dots, footprint, {0.0, 20.0, 0.0, 10.0}, "a <title> & more"};
  }
  TempFolder folder;
  core::DotPattern dots = random_dots(500, 2, 0.03f);
};

void expect_equal(const core::DotPattern& a, const core::DotPattern& b) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_NEAR(a[i].x, b[i].x, 1e-12);
    ASSERT_NEAR(a[i].y, b[i].y, 1e-12);
    ASSERT_NEAR(a[i].radius, b[i].radius, 1e-8f);
    ASSERT_NEAR(a[i].angle, b[i].angle, 1e-6f);
  }
}

TEST_F(DotFiles, CsvReadsBackTheSame) {
  dots[0].angle = 0.5f;
  write_dot_csv(sheet(), folder / "d.csv");
  expect_equal(core::read_dot_csv(folder / "d.csv"), dots);
}

TEST_F(DotFiles, DxfReadsBackTheSame) {
  write_dot_dxf(sheet(), folder / "d.dxf");
  const core::DxfDots found = core::read_dot_dxf(folder / "d.dxf");
  expect_equal(found.dots, dots);
  EXPECT_EQ(found.ignored, 0u);
}

TEST_F(DotFiles, DxfDrawsSquareDotsAsClosedLines) {
  dots.resize(1);
  dots[0] = {1.0, 2.0, 0.05f, 0.0f};
  write_dot_dxf(sheet(core::Footprint::square), folder / "d.dxf");
  const std::string text = file_text(folder / "d.dxf");
  EXPECT_THAT(text, HasSubstr("0\nPOLYLINE\n8\nDOTS\n66\n1\n70\n1\n"));
  EXPECT_THAT(text, HasSubstr("10\n0.950000\n20\n1.950000\n"));
  EXPECT_THAT(text, HasSubstr("10\n1.050000\n20\n2.050000\n"));
}

std::int32_t int_at(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<unsigned char>(bytes[at + i]);
  return static_cast<std::int32_t>(value);
}

/// Walks the records of a stream: counts references and sums the area of what they refer to, in nm2.
struct GdsSum {
  std::size_t references = 0;
  double area = 0.0;
};

GdsSum walk(const std::string& bytes) {
  GdsSum sum;
  std::map<std::string, double> areas;
  std::string structure, referred;
  bool boundary = false;
  for (std::size_t at = 0; at + 4 <= bytes.size();) {
    const std::size_t length = static_cast<std::size_t>(static_cast<unsigned char>(bytes[at])) * 256 +
                               static_cast<unsigned char>(bytes[at + 1]);
    const int type = static_cast<unsigned char>(bytes[at + 2]);
    std::string text = bytes.substr(at + 4, length - 4);
    while (!text.empty() && text.back() == '\0' && (type == 0x06 || type == 0x12)) text.pop_back();
    if (type == 0x06) structure = text;
    if (type == 0x08) boundary = true;
    if (type == 0x0A) boundary = false;
    if (type == 0x12) referred = text;
    if (type == 0x10 && boundary) {
      double twice = 0.0;
      for (std::size_t p = 0; p + 16 <= text.size(); p += 8)
        twice += double(int_at(text, p)) * int_at(text, p + 12) - double(int_at(text, p + 8)) * int_at(text, p + 4);
      areas[structure] = 0.5 * twice;
    } else if (type == 0x10) {
      ++sum.references;
      sum.area += areas.at(referred);
    }
    if (type == 0x04) return sum;
    at += length;
  }
  ADD_FAILURE() << "no end of the library";
  return sum;
}

TEST_F(DotFiles, GdsHoldsEveryDotWithItsArea) {
  for (const core::Footprint footprint : {core::Footprint::round, core::Footprint::square}) {
    write_dot_gds(sheet(footprint), folder / "d.gds");
    const GdsSum sum = walk(file_text(folder / "d.gds"));
    double area = 0.0;
    for (const core::Dot& dot : dots) area += core::footprint_area(footprint, 2.0 * static_cast<double>(dot.radius));
    EXPECT_EQ(sum.references, dots.size());
    EXPECT_NEAR(sum.area * 1e-12 / area, 1.0, 1e-4);
  }
}

TEST_F(DotFiles, GdsRefusesPlacesOutsideItsNumbers) {
  dots[7].x = 3000.0;
  EXPECT_THROW(write_dot_gds(sheet(), folder / "d.gds"), core::Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "d.gds"));
  EXPECT_FALSE(std::filesystem::exists(folder / "d.gds.part"));
}

TEST(GdsReal, AgreesWithTheFormat) {
  EXPECT_EQ(gds_real(0.0), 0u);
  EXPECT_EQ(gds_real(1.0), 0x4110000000000000u);
  EXPECT_EQ(gds_real(-2.0), 0xC120000000000000u);
  EXPECT_EQ(gds_real(1e-3), 0x3E4189374BC6A7F0u);  // as every GDSII file of 1 nm and 1 um begins
  EXPECT_EQ(gds_real(1e-9), 0x3944B82FA09B5A54u);  // to the last bit but rounding
}

TEST_F(DotFiles, SvgShowsAllOrAPart) {
  write_dot_svg(sheet(), folder / "a.svg");
  const std::string all = file_text(folder / "a.svg");
  EXPECT_THAT(all, HasSubstr("<title>a &lt;title&gt; &amp; more</title>"));
  const auto count = [](const std::string& text) {
    std::size_t found = 0;
    for (std::size_t at = text.find("<circle"); at != std::string::npos; at = text.find("<circle", at + 1)) ++found;
    return found;
  };
  EXPECT_EQ(count(all), dots.size());
  write_dot_svg(sheet(), folder / "b.svg", 100);
  EXPECT_NEAR(static_cast<double>(count(file_text(folder / "b.svg"))), 100.0, 45.0);
  EXPECT_THAT(file_text(folder / "b.svg"), HasSubstr("a part in the middle"));
}

TEST_F(DotFiles, AFileGivenUpLeavesNothing) {
  {
    StreamedFile file(folder / "x");
    file.write("half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
  EXPECT_THROW(StreamedFile(folder / "none" / "x"), core::Error);
}

}  // namespace
}  // namespace evenglow::tests
