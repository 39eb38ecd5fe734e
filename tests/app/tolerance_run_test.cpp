#include "app/tolerance_run.h"

#include <cmath>
#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "design/tolerance/figures.h"

/// The state of a run; the run itself is tested in tolerance_test.cpp.
namespace evenglow::app {
namespace {

const core::CellGrid kGrid = core::CellGrid::over(2, 2, 0.0, 0.0, 1.0, 1.0);

const ToleranceBounds kBounds{kGrid, 2, 3};

design::ToleranceSamples samples() {
  design::ToleranceSamples run;
  run.reference.assign(design::kFigures.size(), {0.1, 0.01});

  for (int i = 0; i < 3; ++i) {
    run.samples.push_back({{0.1 * i, 1.0 / 3.0},
                           std::vector<core::Estimate>(design::kFigures.size(), {1.0 / 7.0, 1.0 * i}),
                           {{1.0 / 9.0, 0.5}, {0.25, 1.0 / 11.0}}});
    tracer::LuminanceMap map{core::CellField(kGrid, 100.0 / 3.0 + i), core::CellField(kGrid, 0.1)};
    run.maps.add(map);
  }
  return run;
}

TEST(ToleranceRun, StateComesBackToTheBit) {
  const design::ToleranceSamples run = samples();
  const std::string text = tolerance_state("me", run);
  const design::ToleranceSamples back = read_tolerance_state(text, "me", kBounds);
  EXPECT_EQ(tolerance_state("me", back), text);
  EXPECT_EQ(back.samples[2].parameters, run.samples[2].parameters);
  EXPECT_EQ(back.samples[1].halves.thirteen[1], 1.0 / 11.0);
  EXPECT_EQ(back.maps.maps(false).mean.values, run.maps.maps(false).mean.values);
}

TEST(ToleranceRun, StateOfAnotherRunIsRefused) {
  const std::string text = tolerance_state("me", samples());
  EXPECT_THROW(read_tolerance_state(text, "you", kBounds), core::Error);
  EXPECT_THROW(read_tolerance_state(text, "me", {core::CellGrid::over(3, 2, 0, 0, 1, 1), 2, 3}), core::Error);
}

/// What is told of the state of two or three samples after a change; empty: it is taken.
std::string after(const std::function<void(nlohmann::ordered_json&)>& change) {
  auto node = nlohmann::ordered_json::parse(tolerance_state("me", samples()));
  change(node);
  try {
    read_tolerance_state(node.dump(), "me", kBounds);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

/// Anyone can make a state with a right checksum: read without a look, these were read beyond lists or gave figures of
/// other columns.
TEST(ToleranceRun, StateThatNoRunWritesIsRefused) {
  using testing::HasSubstr;
  using Json = nlohmann::ordered_json;
  EXPECT_EQ(after([](Json&) {}), "");
  const char* other = "a sample of it has other parameters";
  EXPECT_THAT(after([](Json& s) { s["samples"][0]["parameters"] = std::vector<double>(20000, 1.0); }),
              HasSubstr(other));
  EXPECT_THAT(after([](Json& s) { s["samples"][2]["parameters"] = Json::array(); }), HasSubstr(other));
  EXPECT_THAT(after([](Json& s) { s["samples"].push_back(s["samples"][0]); }), HasSubstr("more samples"));
  const char* range = "a figure of it is out of range";
  EXPECT_THAT(after([](Json& s) { s["samples"][1]["figures"][3] = {-5.0, 1.0}; }), HasSubstr(range));
  EXPECT_THAT(after([](Json& s) { s["samples"][1]["figures"][0] = {-5.0, 1.0}; }), HasSubstr(range));
  EXPECT_THAT(after([](Json& s) { s["samples"][1]["figures"][5] = {1.5, 0.1}; }), HasSubstr(range));
  EXPECT_THAT(after([](Json& s) { s["samples"][1]["figures"][1] = {nullptr, 0.1}; }), HasSubstr(range));
  EXPECT_THAT(after([](Json& s) { s["reference"][2] = {0.5, -0.1}; }), HasSubstr(range));
  EXPECT_THAT(after([](Json& s) { s["maps"].push_back(1.0); }), HasSubstr("other cells"));
  EXPECT_NE(after([](Json& s) { s["maps"][0] = nullptr; }), "");
}

}  // namespace
}  // namespace evenglow::app
