#include "design/report/html_metrology.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "design/report/html_writer.h"
#include "tests/design/metrology_samples.h"

namespace evenglow::design {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(HtmlMetrology, TellsTheFiguresWithTheirErrors) {
  const std::string html = report_html(samples::report_with_metrology());
  for (const char* text : {"<h2>Color</h2>", "0.29310 \u00b1 0.00020, 0.32040 \u00b1 0.00030", "7776 \u00b1 19", "8001",
                           "0.00221 \u00b1 0.00011", "0.00570 \u00b1 0.00060", "Cells without light, left out",
                           "<h2>Hot spots</h2>", "1.500 \u00b1 0.025 at 0.7500 mm", "beyond 1.500 mm",
                           "width 63.75 \u00b1 0.60", "no such angle", "spot at x 6.000 mm, y 3.000 mm"}) {
    EXPECT_THAT(html, HasSubstr(text));
  }
  const std::string once = "<figcaption>Standard error of \u0394u\u2032v\u2032";
  ASSERT_NE(html.find(once), std::string::npos);
  EXPECT_EQ(html.find(once), html.rfind(once));
  EXPECT_THAT(html, Not(HasSubstr("negative: noise")));
}

TEST(HtmlMetrology, LeavesOutWhatIsNotThere) {
  Report plain = samples::report();
  plain.angular.reset();
  const std::string html = report_html(plain);
  for (const char* text : {"<h2>Color</h2>", "<h2>Hot spots</h2>", "Half of the greatest"}) {
    EXPECT_THAT(html, Not(HasSubstr(text)));
  }
  PageData data;
  EXPECT_EQ(color_section(plain, data), "");
  EXPECT_EQ(hot_spot_section(plain, data), "");
  EXPECT_EQ(half_angle_table({&plain}), "");
}

TEST(HtmlMetrology, ComparisonsNameTheColorsSideBySide) {
  const std::string html =
      report_html(compare_reports("t", "c", {samples::report_with_metrology("a"), samples::report("b")}));
  EXPECT_THAT(html, HasSubstr("<td>color temperature</td><td class=\"n\">7776 \u00b1 19</td><td class=\"n\"></td>"));
  EXPECT_THAT(report_html(compare_reports("t", "c", {samples::report("a"), samples::report("b")})),
              Not(HasSubstr("color temperature")));
}

TEST(HtmlMetrology, AHostileEdgeStaysText) {
  Report r = samples::report_with_metrology();
  r.hot_spots[0].edge = "</script><img src=x>";
  const std::string html = report_html(r);
  EXPECT_EQ(html.find("<img"), std::string::npos);
}

TEST(HtmlMetrology, ACurveForEachRow) {
  const Report r = samples::report_with_metrology();
  const CurvePlot plot = hot_spot_plot({r.hot_spots[0], r.hot_spots[0]});
  ASSERT_EQ(plot.curves.size(), 2U);
  EXPECT_EQ(plot.curves[0].x, (std::vector<double>{0.75, 2.25}));
  EXPECT_EQ(plot.curves[0].y, (std::vector<double>{1.5, 1.01}));
  EXPECT_EQ(plot.curves[0].se, (std::vector<double>{0.025, 0.01}));
}

}  // namespace
}  // namespace evenglow::design
