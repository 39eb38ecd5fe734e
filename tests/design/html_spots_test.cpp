#include "design/report/html_spots.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "design/problem/merit.h"
#include "design/report/number_format.h"
#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = 0; (at = text.find(part, at)) != std::string::npos; at += part.size()) ++n;
  return n;
}

TEST(HtmlSpots, TellsPlaceAndLuminanceOfThirteen) {
  Report r = samples::report();
  r.luminance = samples::ramp(60, 30, 1000.0);
  const std::string html = spot_table({&r});
  EXPECT_EQ(count(html, "<tr>"), 14U);
  EXPECT_EQ(count(html, "<td>9 and 13</td>"), 9U);
  for (const SpotValue& spot : uniformity_spots(r.luminance)) {
    EXPECT_NE(html.find(fmt::format(">{}</td><td class=\"n\">{}<", rounded(spot.x), rounded(spot.y))),
              std::string::npos);
    EXPECT_NE(html.find(fmt::format(">{}<", rounded(spot.luminance))), std::string::npos);
  }
}

TEST(HtmlSpots, EscapesNamesAndLeavesOutWhatHasNoMap) {
  const Report a = samples::report("<i>");
  const Report none;
  const std::string html = spot_table({&a, &none});
  EXPECT_EQ(html.find("<i>"), std::string::npos);
  EXPECT_EQ(count(html, "cd/m\u00b2</th>"), 1U);
  EXPECT_EQ(spot_table({&none}), "");
}

}  // namespace
}  // namespace evenglow::design
