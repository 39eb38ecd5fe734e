#include "design/report/study.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/program.h"

namespace evenglow::design {
namespace {

using testing::HasSubstr;
using testing::Not;

Study sample() {
  Study study;
  study.title = "A <study>";
  study.lead = "What is shown.";
  study.columns = {"method", "RMS (%)"};
  study.rows = {{"ratio", "1.2"}, {"auto & more", "0.52"}};
  CurvePlot plot;
  plot.title = "RMS";
  plot.curves.resize(1);
  plot.curves[0] = {"one", Ink::series_1, {1, 2, 3}, {3, 2, 1}, {0.1, 0.1, 0.1}, true, true, false, Mark::disc, true};
  study.plots = {plot};
  study.densities = {{"Level 0.1", "", core::CellField(core::CellGrid::over(4, 2, 0, 0, 4, 2), 0.1)}};
  return study;
}

TEST(Study, PageHoldsAllAndEscapes) {
  const std::string html = study_html(sample());
  EXPECT_THAT(html, HasSubstr("A &lt;study&gt;"));
  EXPECT_THAT(html, Not(HasSubstr("A <study>")));
  EXPECT_THAT(html, HasSubstr("<td>auto &amp; more</td><td>0.52</td>"));
  EXPECT_THAT(html, HasSubstr("Level 0.1"));
  EXPECT_THAT(html, HasSubstr("data-curves"));
}

TEST(Study, NoTextBecomesMarkup) {
  const std::string attack = "</script><b onclick='alert(1)'>\"x";
  Study study = sample();
  for (std::string* text : {&study.title, &study.version, &study.command, &study.run_file, &study.lead,
                            &study.columns[0], &study.rows[0][0], &study.plots[0].title, &study.plots[0].curves[0].name,
                            &study.densities[0].title, &study.densities[0].caption}) {
    *text = attack;
  }
  study.notes = {attack};
  EXPECT_THAT(study_html(study), Not(HasSubstr("<b onclick")));
}

TEST(Study, DensitiesHaveNoUnit) {
  EXPECT_THAT(study_html(sample()), Not(HasSubstr("\"unit\":\"1\"")));
}

TEST(Study, AWideTableScrollsWithinItsBox) {
  EXPECT_THAT(study_html(sample()), HasSubstr("<div class=\"scroll\"><table>"));
}

TEST(Study, TextHasAlignedColumns) {
  EXPECT_EQ(study_text(sample()),
            "method       RMS (%)\n"
            "ratio            1.2\n"
            "auto & more     0.52\n");
}

TEST(Study, PictureIsWritten) {
  const tests::TempFolder folder;
  write_study_png(sample(), folder.path() / "study.png");
  EXPECT_GT(std::filesystem::file_size(folder.path() / "study.png"), 5000U);
}

}  // namespace
}  // namespace evenglow::design
