#include "design/report/named_maps.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/design/metrology_samples.h"

namespace evenglow::design {
namespace {

using ::testing::ElementsAre;

std::vector<std::string> names(const std::vector<NamedMap>& maps) {
  std::vector<std::string> list;
  for (const NamedMap& map : maps) list.push_back(map.name);
  return list;
}

TEST(NamedMaps, AreAllThatHaveValues) {
  EXPECT_THAT(names(named_maps(samples::report())),
              ElementsAre("luminance", "luminance_se", "start_luminance", "density"));
  EXPECT_THAT(names(named_maps(samples::report_with_metrology())),
              ElementsAre("luminance", "luminance_se", "start_luminance", "density", "color_u", "color_u_se", "color_v",
                          "color_v_se", "delta_uv", "delta_uv_se"));
  EXPECT_TRUE(named_maps(Report{}).empty());
}

TEST(NamedMaps, OfAComparisonAreNamedAfterTheVariantsAndNeverTwice) {
  const Comparison comparison = compare_reports(
      "t", "c", {samples::report("lpp"), samples::report("a b"), samples::report("a/b"), samples::report("a\"<b>")});
  const auto list = names(named_maps(comparison));
  EXPECT_EQ(list.size(), 15U);
  EXPECT_EQ(std::set<std::string>(list.begin(), list.end()).size(), list.size());
  EXPECT_EQ(list[0], "ratio_a_b_over_lpp");
  for (const std::string& name : list)
    EXPECT_EQ(name.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789"), std::string::npos) << name;
  EXPECT_TRUE(named_maps(compare_reports("t", "c", {samples::report("lpp")})).empty());
}

}  // namespace
}  // namespace evenglow::design
