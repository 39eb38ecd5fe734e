#include "design/report/json_metrology.h"

#include <gtest/gtest.h>

#include "design/report/json_writer.h"
#include "tests/design/metrology_samples.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;

TEST(JsonMetrology, StandsInTheResult) {
  const Json json = Json::parse(result_json(samples::report_with_metrology()));
  EXPECT_EQ(json["color"]["mean"]["cct_k"], 7776.0);
  EXPECT_EQ(json["color"]["mean"]["u_se"], 1e-4);
  EXPECT_EQ(json["color"]["emitted"]["v"], 0.4555);
  EXPECT_EQ(json["color"]["delta_uv_rms_corrected"], 0.00221);
  EXPECT_EQ(json["color"]["delta_uv_rms_corrected_se"], 0.00011);
  EXPECT_EQ(json["color"]["delta_uv_max_corrected"], 0.0057);
  EXPECT_EQ(json["color"]["delta_uv_max_at_mm"], (Json{7.0, 2.5}));
  EXPECT_EQ(json["color"]["dark_cells"], 1);
  EXPECT_EQ(json["half_maximum"]["horizontal"]["from_deg"], -31.5);
  EXPECT_EQ(json["half_maximum"]["horizontal"]["width_deg_se"], 0.6);
  EXPECT_TRUE(json["half_maximum"]["vertical"].is_null());
  EXPECT_EQ(json["half_maximum"]["spots"][0]["horizontal"]["to_deg"], 32.25);
  EXPECT_EQ(json["half_maximum"]["spots"][0]["diameter_mm"], 1.5);
  EXPECT_EQ(json["hot_spot"][0]["source"], 2);
  EXPECT_EQ(json["hot_spot"][0]["ratio"], 1.5);
  EXPECT_EQ(json["hot_spot"][0]["ratio_se"], 0.025);
  EXPECT_EQ(json["hot_spot"][0]["distance_mm"], 0.75);
  EXPECT_EQ(json["hot_spot"][0]["mixing_distance_mm"], 1.5);
  EXPECT_EQ(std::prev(json.end()).key(), "timing");
}

TEST(JsonMetrology, WhatIsNotKnownIsNullOrLeftOut) {
  Report r = samples::report_with_metrology();
  r.hot_spots[0].mixing_distance.reset();
  EXPECT_TRUE(Json::parse(result_json(r))["hot_spot"][0]["mixing_distance_mm"].is_null());
  const Json plain = Json::parse(result_json(samples::report()));
  EXPECT_FALSE(plain.contains("color"));
  EXPECT_FALSE(plain.contains("hot_spot"));
  EXPECT_FALSE(plain["half_maximum"].contains("spots"));
}

TEST(JsonMetrology, StandsInTheComparison) {
  const auto comparison = compare_reports("t", "c", {samples::report_with_metrology("a"), samples::report("b")});
  const Json json = Json::parse(comparison_json(comparison));
  EXPECT_EQ(json["variants"]["a"]["color"]["shift_uv"], 0.0052);
  EXPECT_FALSE(json["variants"]["b"].contains("color"));
}

}  // namespace
}  // namespace evenglow::design
