#include "design/report/html_writer.h"

#include <limits>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

nlohmann::ordered_json data_of(const std::string& html) {
  const std::string open = "<script type=\"application/json\" id=\"data\">";
  const std::size_t from = html.find(open) + open.size();
  return nlohmann::ordered_json::parse(html.substr(from, html.find("</script>", from) - from));
}

/// Every text that a user may choose is the same attack.
Report hostile(const std::string& attack) {
  Report r = samples::report(attack);
  for (std::string* text :
       {&r.version, &r.title, &r.command, &r.run_file_text, &r.run_file_sha256, &r.stop_reason, &r.luminance_estimator,
        &r.energy.absorbed[0].name, &r.energy.escaped[0].name, &r.processor}) {
    *text = attack;
  }
  r.overrides = r.notes = {attack};
  r.films = {{attack, 0.0, 0.05, {attack}}};
  return r;
}

TEST(HtmlWriter, NothingFromTheUserBecomesMarkup) {
  const std::string attack = "</script><script>alert(1)</script><!--<img src=x onerror='a' title=\"b\">\xff";
  const Report r = hostile(attack);
  Report other = hostile("x" + attack);
  for (const std::string& html : {report_html(r), report_html(compare_reports(attack, attack, {r, other}))}) {
    EXPECT_EQ(count(html, "<script"), 2U);  // the data and the page's own
    EXPECT_EQ(count(html, "</script"), 2U);
    EXPECT_EQ(html.find("alert(1)</script"), std::string::npos);
    EXPECT_EQ(html.find("<img"), std::string::npos);
    EXPECT_EQ(html.find("<!--<"), std::string::npos);
    const std::string body = html.substr(0, html.find("<script"));
    EXPECT_EQ(body.find("onerror='"), std::string::npos);
    EXPECT_EQ(body.find("title=\"b"), std::string::npos);
    EXPECT_EQ(html.find('\xff'), std::string::npos);
    EXPECT_GT(count(html, "&lt;/script&gt;&lt;script&gt;alert(1)"), 5U);
    EXPECT_NO_THROW(data_of(html));
  }
}

TEST(HtmlWriter, LoadsNothingFromOutside) {
  const std::string html = report_html(samples::report());
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
  for (const char* load : {" src=", "@import", "url(", "fetch(", "<link rel=\"stylesheet\"", "https://"}) {
    EXPECT_EQ(html.find(load), std::string::npos) << load;
  }
}

TEST(HtmlWriter, EmbedsMapsWithTheirErrorsOnOneScale) {
  const Report r = samples::report();
  const nlohmann::ordered_json data = data_of(report_html(r));
  std::vector<nlohmann::ordered_json> maps;  // in the order of the page
  for (const auto& item : data) {
    if (item.contains("nx") && item["unit"] != "") maps.push_back(item);
  }
  ASSERT_EQ(maps.size(), 3U);  // start, final, standard error
  EXPECT_EQ(maps[0]["scale"], maps[1]["scale"]);
  EXPECT_EQ(maps[1]["v"].size(), 24U);
  EXPECT_NEAR(maps[1]["v"][5].get<double>(), r.luminance.values[5], 1e-4 * r.luminance.values[5]);
  EXPECT_NEAR(maps[1]["s"][5].get<double>(), r.luminance_se.values[5], 1e-4 * r.luminance_se.values[5]);
  EXPECT_TRUE(maps[0]["s"].empty());
}

TEST(HtmlWriter, TellsTheHeadlineFiguresAndTheSumOfTheEnergy) {
  const std::string html = report_html(samples::report());
  for (const char* text :
       {"10.00 ± 0.10", "50.00 ± 0.10", "1000.0 ± 3.0", "25.000 ± 0.050\u00a0%", "100.0000\u00a0%",
        "evenglow design run.yaml", "trace.seed=7", "the upper limit of the density binds", "ab12"}) {
    EXPECT_NE(html.find(text), std::string::npos) << text;
  }
}

TEST(HtmlWriter, ComparisonBeginsWithTheRatios) {
  Report brighter = samples::report("dbef");
  brighter.final.luminance_mean = {1500.0, 4.5};
  const std::string html = report_html(compare_reports("t", "c", {samples::report("lpp"), brighter}));
  const std::size_t ratio = html.find("1.5000 ± 0.0064");  // sqrt(2) * 0.003 * 1.5
  ASSERT_NE(ratio, std::string::npos);
  EXPECT_LT(ratio, html.find("Final figures"));
  EXPECT_EQ(count(html, "<details class=\"variant\">"), 2U);
}

TEST(HtmlWriter, ThreeDesignsStayBelowThreeMegabytes) {
  std::vector<Report> variants;
  for (const char* name : {"lpp", "dbef", "dbef_lpp"}) {
    Report r = samples::report(name);
    r.start_luminance = r.luminance = r.luminance_se = samples::ramp(96, 48, 1000.0 / 3.0);
    r.density = samples::ramp(96, 48, 1.0 / 7.0);
    variants.push_back(r);
  }
  EXPECT_LT(report_html(compare_reports("t", "c", variants)).size(), 3000000U);
}

/// As large as the promise: 128 x 72 cells, two designs.
std::string large_page() {
  std::vector<Report> variants;
  for (const char* name : {"lpp", "dbef"}) {
    Report r = samples::report(name);
    r.start_luminance = r.luminance = r.luminance_se = samples::ramp(128, 72, 1234.567891 / 3.0);
    r.density = samples::ramp(128, 72, 0.123456789);
    r.target = samples::ramp(128, 72, 1.0);
    variants.push_back(r);
  }
  return report_html(compare_reports("t", "c", variants));
}

TEST(HtmlWriter, TwoDesignsOf128By72CellsStayBelowFiveMegabytes) {
  EXPECT_LT(large_page().size(), 5000000U);
}

TEST(HtmlWriter, HasItsParts) {
  Report r = samples::report();
  r.processor = "Chip A";
  r.films = {{"dbef", 0.0, 0.05, {"a remark"}}};
  const std::string html = report_html(r);
  for (const char* part : {"svg class=\"energy\"", "Histogram of the cells", "class=\"spots\"", "table class=\"films\"",
                           "Chip A", "data-cut=\"maps\"", "data-palette", "data-scales=\"maps\""}) {
    EXPECT_NE(html.find(part), std::string::npos) << part;
  }
}

TEST(HtmlWriter, WritesWhateverTheNumbers) {
  Report r = samples::report();
  r.luminance.values[2] = std::numeric_limits<double>::quiet_NaN();
  r.angular.reset();
  r.steps.resize(1);
  r.final.efficiency = {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};
  EXPECT_NO_THROW(data_of(report_html(r)));
  EXPECT_NO_THROW(data_of(report_html(Report{})));
  const std::string html = report_html(compare_reports("", "", {Report{}, Report{}}));
  EXPECT_NO_THROW(data_of(html));
  EXPECT_EQ(count(html, "nan"), count(html, "uminance"));
}

}  // namespace
}  // namespace evenglow::design
