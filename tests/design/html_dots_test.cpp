#include "design/report/html_dots.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/report/csv_writer.h"
#include "design/report/json_writer.h"
#include "tests/design/dots_report.h"

/// What the reports tell of a design's real dots.
namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

TEST(HtmlDots, SectionShowsBothJudgmentsRoundsAndMaps) {
  PageData data;
  const std::string html = dots_section(samples::with_dots(), "", data);
  EXPECT_THAT(html, HasSubstr("The design as real dots"));
  EXPECT_THAT(html, HasSubstr("reached: &lt;enough&gt;"));
  EXPECT_THAT(html, HasSubstr("<td>chosen</td>"));
  EXPECT_THAT(html, HasSubstr("1.23"));
  for (const char* map : {"Luminance of the density", "Luminance of the dots", "Dots over density"})
    EXPECT_THAT(html, HasSubstr(map));
  EXPECT_THAT(html, HasSubstr("mean 0.9800, 0.9800"));
  EXPECT_EQ(dots_section(samples::report(), "", data), "");
}

TEST(HtmlDots, MatricesOfTheDots) {
  const samples::Folder folder("html_dots");
  CsvWriter().write(samples::with_dots(), folder.path());
  EXPECT_THAT(samples::content(folder.path() / "dots_luminance.csv"), HasSubstr("# luminance of the dots (cd/m2)"));
  EXPECT_THAT(samples::content(folder.path() / "dots_density.csv"), HasSubstr("dots were placed for"));
  EXPECT_FALSE(samples::content(folder.path() / "dots_luminance_se.csv").empty());
}

}  // namespace
}  // namespace evenglow::design
