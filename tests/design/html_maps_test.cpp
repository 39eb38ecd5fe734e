#include "design/report/html_maps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::vector<nlohmann::json> maps_of(const PageData& data) {
  std::vector<nlohmann::json> maps;
  const nlohmann::json parsed = nlohmann::json::parse(data.json());
  for (int i = 0; parsed.contains(fmt::format("d{}", i)); ++i) maps.push_back(parsed[fmt::format("d{}", i)]);
  return maps;
}

TEST(HtmlMaps, VariantsHaveOneScaleAndTheRelationsTheirs) {
  Report a = samples::report("lpp");
  Report b = samples::report("dbef");
  for (double& value : b.luminance.values) value *= 2.0;
  PageData data;
  variant_luminance_maps({&a, &b}, data);
  const std::string html = relation_maps({&a, &b}, data);
  const auto maps = maps_of(data);
  ASSERT_EQ(maps.size(), 5U);
  EXPECT_EQ(maps[0]["scale"], maps[1]["scale"]);
  EXPECT_EQ(maps[2]["quantity"], "ratio");
  EXPECT_NEAR(maps[2]["v"][3].get<double>(), 2.0, 1e-4);
  EXPECT_EQ(maps[2]["series"], 1);  // the color of dbef
  EXPECT_EQ(maps[3]["quantity"], "difference");
  EXPECT_NEAR(maps[3]["v"][3].get<double>(), a.luminance.values[3], 1e-4 * a.luminance.values[3]);
  EXPECT_EQ(maps[3]["scale"][0].get<double>(), -maps[3]["scale"][1].get<double>());
  EXPECT_EQ(maps[4]["name"], "dbef \u2212 lpp");
  EXPECT_NE(html.find("data-cut=\"ratio-maps\""), std::string::npos);
}

TEST(HtmlMaps, NamesVariantsOnOtherCellsInstead) {
  const Report a = samples::report("lpp");
  Report b = samples::report("<b>");
  b.luminance = samples::ramp(3, 3, 1.0);
  PageData data;
  const std::string html = relation_maps({&a, &b}, data);
  EXPECT_NE(html.find("On other cells than lpp, so not shown here: &lt;b&gt;."), std::string::npos);
  EXPECT_EQ(html.find("ratio-maps"), std::string::npos);
  EXPECT_EQ(relation_maps({&a}, data), "");
}

TEST(HtmlMaps, ARunThatDesignsShowsItsStart) {
  Report r = samples::report();
  PageData design;
  run_maps(r, "-0", design);
  EXPECT_EQ(maps_of(design).size(), 4U);
  r.steps.resize(1);
  PageData single;
  const std::string html = run_maps(r, "-0", single);
  EXPECT_EQ(maps_of(single).size(), 3U);
  EXPECT_NE(html.find("id=\"maps-0\""), std::string::npos);
  EXPECT_NE(html.find("data-scales=\"maps-0\""), std::string::npos);
}

}  // namespace
}  // namespace evenglow::design
