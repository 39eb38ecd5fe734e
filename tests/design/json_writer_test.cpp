#include "design/report/json_writer.h"

#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/design/report_samples.h"

namespace evenglow::design {
namespace {

using Json = nlohmann::ordered_json;
using testing::ElementsAre;
using testing::IsSupersetOf;

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

TEST(JsonWriter, ResultHasThePromisedKeys) {
  const Json json = Json::parse(result_json(samples::report()));
  EXPECT_EQ(json["format"], "evenglow-result/1");
  EXPECT_THAT(keys(json), IsSupersetOf({"format", "version", "title", "run_file_sha256", "seed", "threads", "ranks",
                                        "stop_reason", "steps", "final", "energy", "timing", "command", "overrides",
                                        "luminance_estimator", "notes"}));
  EXPECT_THAT(keys(json["steps"][0]), ElementsAre("step", "photons", "rms", "rms_corrected", "rms_corrected_se",
                                                  "efficiency", "efficiency_se", "mean_density", "luminance_mean_cd_m2",
                                                  "noise", "held_low", "held_high", "updater", "level_photons"));
  EXPECT_THAT(
      keys(json["final"]),
      ElementsAre("photons", "rms", "rms_corrected", "rms_corrected_se", "uniformity_9", "uniformity_13",
                  "luminance_mean_cd_m2", "luminance_mean_se", "luminance_centre_cd_m2", "efficiency", "efficiency_se",
                  "rms_95_low", "rms_95_high", "uniformity_9_se", "uniformity_13_se", "luminance_centre_se"));
  EXPECT_THAT(keys(json["energy"]), ElementsAre("emitted_lm", "escaped", "absorbed", "lost"));
  EXPECT_THAT(keys(json["energy"]["escaped"]), ElementsAre("left", "right", "front", "back", "bottom", "top"));
  EXPECT_THAT(keys(json["timing"]), ElementsAre("wall_s", "cpu_s", "photons_per_cpu_s", "processor", "steps"));
  EXPECT_THAT(keys(json["timing"]["steps"][0]), ElementsAre("step", "cpu_s", "wall_s"));
}

TEST(JsonWriter, ValuesStandAtTheirKeys) {
  const Json json = Json::parse(result_json(samples::report()));
  EXPECT_EQ(json["steps"].size(), 3U);
  EXPECT_EQ(json["steps"][2]["luminance_mean_cd_m2"], 902.0);
  EXPECT_EQ(json["steps"][1]["rms_corrected_se"], 0.001);
  EXPECT_EQ(json["final"]["luminance_centre_cd_m2"], 1010.0);
  EXPECT_EQ(json["final"]["uniformity_13"], 0.8);
  EXPECT_EQ(json["energy"]["absorbed"]["white sheet"], 0.25);
  EXPECT_EQ(json["energy_se"]["absorbed"]["white sheet"], 5e-4);
  EXPECT_EQ(json["energy"]["emitted_lm"], 100.0);
  EXPECT_EQ(json["seed"], 7);
}

TEST(JsonWriter, OnlyTimingThreadsAndRanksTellOfTheMachine) {
  Report here = samples::report();
  Report there = here;
  there.timing = {1, 2, 3};
  there.threads = 64;
  there.ranks = 8;
  for (StepRecord& step : there.steps) step.cpu_s = step.wall_s = 99.0;
  Json a = Json::parse(result_json(here));
  Json b = Json::parse(result_json(there));
  EXPECT_NE(a, b);
  for (const char* key : {"timing", "threads", "ranks"}) {
    a.erase(key);
    b.erase(key);
  }
  EXPECT_EQ(a.dump(), b.dump());
}

TEST(JsonWriter, SharesSumToOneEvenIfTwoPartsHaveOneName) {
  Report r = samples::report();
  r.energy.absorbed[1].name = r.energy.absorbed[0].name;
  const Json json = Json::parse(result_json(r))["energy"];
  double sum = json["lost"];
  for (const auto& group : {json["escaped"], json["absorbed"]}) {
    for (const auto& [name, share] : group.items()) sum += share.get<double>();
  }
  EXPECT_NEAR(sum, 1.0, 1e-12);
}

TEST(JsonWriter, NumbersReadBackAndNotANumberIsNull) {
  Report r = samples::report();
  r.final.rms = 0.1 + 0.2;
  r.final.uniformity_9 = std::numeric_limits<double>::quiet_NaN();
  r.final.efficiency.se = std::numeric_limits<double>::infinity();
  const Json json = Json::parse(result_json(r));
  EXPECT_EQ(json["final"]["rms"].get<double>(), 0.1 + 0.2);
  EXPECT_TRUE(json["final"]["uniformity_9"].is_null());
  EXPECT_TRUE(json["final"]["efficiency_se"].is_null());
}

TEST(JsonWriter, IllFormedTextIsNoReasonToFail) {
  Report r = samples::report();
  r.title = "caf\xe9 \"x\"\n";
  EXPECT_EQ(Json::parse(result_json(r))["title"], "caf\uFFFD \"x\"\n");
}

TEST(JsonWriter, ComparisonHasFinalFiguresAndRatios) {
  const Comparison c = compare_reports("t", "c", {samples::report("lpp"), samples::report("dbef")});
  const Json json = Json::parse(comparison_json(c));
  EXPECT_THAT(keys(json["variants"]), ElementsAre("lpp", "dbef"));
  EXPECT_EQ(json["variants"]["dbef"]["luminance_mean_cd_m2"], 1000.0);
  EXPECT_THAT(keys(json["ratio"]), ElementsAre("dbef/lpp"));
  EXPECT_THAT(keys(json["ratio"]["dbef/lpp"]),
              ElementsAre("luminance", "luminance_se", "flux", "flux_se", "efficiency", "efficiency_se"));
  EXPECT_EQ(json["ratio"]["dbef/lpp"]["flux"], 1.0);
}

}  // namespace
}  // namespace evenglow::design
