#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/config/config_node.h"

/// The points of a sweep.
namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

std::vector<std::string> points_of(const std::string& yaml) {
  const ConfigDocument document = ConfigDocument::parse(yaml, "run.yaml");
  std::vector<std::string> result;
  for (const auto& [name, changes] : document.sweep()) {
    std::string text = name + ":";
    for (const auto& change : changes) text += " " + change.path + "=" + change.yaml;
    result.push_back(text);
  }
  document.finish();
  return result;
}

std::string fault_of(const std::string& yaml) {
  try {
    points_of(yaml);
  } catch (const ConfigError& error) {
    return error.faults().front().to_string();
  }
  return "no fault";
}

TEST(ConfigSweep, AGridIsAllCombinationsTheLastKeyRunningFastest) {
  EXPECT_THAT(
      points_of("sweep: {grid: {trace.seed: [1, 2], \"films[0].haze\": [0.8, 0.9, 1]}}"),
      ElementsAre(
          "p1_seed-1_haze-0.8: trace.seed=1 films[0].haze=0.8", "p2_seed-1_haze-0.9: trace.seed=1 films[0].haze=0.9",
          "p3_seed-1_haze-1: trace.seed=1 films[0].haze=1", "p4_seed-2_haze-0.8: trace.seed=2 films[0].haze=0.8",
          "p5_seed-2_haze-0.9: trace.seed=2 films[0].haze=0.9", "p6_seed-2_haze-1: trace.seed=2 films[0].haze=1"));
}

TEST(ConfigSweep, AZipTakesValuesTogether) {
  EXPECT_THAT(points_of("sweep: {zip: {a.b: [1, 2], c: [x, {kind: lpp}]}}"),
              ElementsAre("p1_b-1_c-x: a.b=1 c=x", "p2_b-2_c: a.b=2 c={kind: lpp}"));
}

TEST(ConfigSweep, AListTellsEachPoint) {
  EXPECT_THAT(points_of("sweep:\n  list:\n    - {a: 1}\n    - {b: 2, c: '../3'}\n    - {}\n"),
              ElementsAre("p1_a-1: a=1", "p2_b-2_c: b=2 c=\"../3\"", "p3:"));
}

TEST(ConfigSweep, NamesSortAsThePointsDo) {
  std::string values;
  for (int i = 0; i < 120; ++i) values += std::to_string(200 - i) + ", ";
  const auto points = points_of("sweep: {grid: {a: [" + values + "0]}}");
  EXPECT_EQ(points.front(), "p001_a-200: a=200");
  EXPECT_TRUE(std::is_sorted(points.begin(), points.end()));
}

TEST(ConfigSweep, WithoutOneThereAreNoPoints) {
  EXPECT_EQ(fault_of("sweep:\n"), "run.yaml:1:1: sweep: must be a map, got nothing");
  const ConfigDocument document = ConfigDocument::parse("title: x", "run.yaml");
  EXPECT_TRUE(document.sweep().empty());
}

TEST(ConfigSweep, ItsFaultsAreToldWithTheirPlace) {
  EXPECT_EQ(fault_of("sweep: {}"), "run.yaml:1:8: sweep: must hold one of grid, zip and list, got none");
  EXPECT_EQ(fault_of("sweep: {zip: {a: [1]}, grid: {a: [1]}}"),
            "run.yaml:1:8: sweep: must hold one of grid, zip and list, got several");
  EXPECT_EQ(fault_of("sweep: {grid: {a: 3}}"),
            "run.yaml:1:19: sweep.grid.a: must be a list of at least one value, got 3");
  EXPECT_THAT(fault_of("sweep: {grid: {a: []}}"), HasSubstr("must be a list of at least one value, got"));
  EXPECT_EQ(fault_of("sweep: {zip: {a: [1, 2], b: [1]}}"),
            "run.yaml:1:14: sweep.zip: must give each key as many values as the first (2), at most 10000, got 1 for b");
  EXPECT_THAT(fault_of("sweep: {list: [3]}"), HasSubstr("run.yaml:1:16: sweep.list[0]: must be a map, got 3"));
  EXPECT_THAT(fault_of("sweep: {list: {a: 1}}"), HasSubstr("sweep.list: must be a list"));
  EXPECT_THAT(fault_of("sweep: {steps: 3}"), HasSubstr("sweep"));
}

TEST(ConfigSweep, TooManyPointsAreRefused) {
  std::string values = "0";
  for (int i = 1; i < 101; ++i) values += ", " + std::to_string(i);
  EXPECT_THAT(fault_of("sweep: {grid: {a: [" + values + "], b: [" + values + "]}}"),
              HasSubstr("must not make more than 10000 points"));
}

}  // namespace
}  // namespace evenglow::core
