#include <cmath>
#include <string>

#include <gtest/gtest.h>

#include "design/engine/step_judgment.h"
#include "design/engine/traced_model.h"
#include "design/problem/merit.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"
#include "tracer/transport/arrival_records.h"

/// Several directions of view in one trace. Seeds fixed; false alarms 1e-3 for each test.
namespace evenglow::design {
namespace {

/// A plate whose prism sheet makes the luminance depend on the direction.
std::string plate(const std::string& receiver) {
  return "light_guide_plate: {length_mm: 30, width_mm: 15, thickness_mm: 0.6}, microstructure: {cells: [4, 2], "
         "density: "
         "0.1, kind: printed_dot, reflectance: 0.95}, sources: [{kind: led_row, count: 3, reflectance: 0.5}], "
         "reflectors: {bottom: {}, right: {}, front: {}, back: {}}, films: [{kind: diffuser}, {kind: bef}], receivers: "
         "[{kind: luminance, cells: [4, 2], " +
         receiver + "}]";
}

const std::string kViews =
    "views: [{direction_deg: [0, 0], weight: 3}, {direction_deg: [30, 0], weight: 1}, {direction_deg: [50, 90], "
    "weight: 2}]";
const char* const kDirections[] = {"[0, 0]", "[30, 0]", "[50, 90]"};

Observation observed(const std::string& receiver, std::uint64_t seed, std::uint64_t photons, bool recorded = false) {
  const tracer::Scene scene = tests::scene_of(plate(receiver));
  TracedModelOptions options;
  options.seed = seed;
  options.threads = 2;
  const ForwardModel model = traced_model(scene, options);
  return *(recorded ? model.recording : model)(initial_density(scene.spec), photons, 0);
}

/// Each direction of a trace of three against a trace of its own: mean luminance and cells.
void expect_those_of_single_traces(const std::string& estimator) {
  const std::string keys = "cone_deg: 20, estimator: " + estimator + ", ";
  const std::uint64_t photons = estimator == "counting" ? 1'000'000 : 200'000;
  const Observation all = observed(keys + kViews, 1, photons);
  ASSERT_EQ(all.views.size(), 3U);
  const double limit = tests::z_limit(1e-3, 3 * 9);
  for (std::size_t v = 0; v < 3; ++v) {
    const Observation one = observed(keys + "direction_deg: " + kDirections[v], 2 + v, photons);
    const core::Estimate a = mean_of_cells(all.views[v].luminance), b = mean_of_cells(one.luminance);
    EXPECT_LT(std::abs(a.value - b.value) / std::hypot(a.se, b.se), limit) << estimator << v;
    EXPECT_LT(std::hypot(a.se, b.se) / b.value, 0.03);
    for (std::size_t cell = 0; cell < 8; ++cell) {
      const core::Estimate p = all.views[v].luminance.total(cell), q = one.luminance.total(cell);
      EXPECT_LT(std::abs(p.value - q.value) / std::hypot(p.se, q.se), limit) << estimator << v << ", cell " << cell;
    }
  }
  // The directions differ, so that mixing them up would show.
  EXPECT_GT(mean_of_cells(all.views[0].luminance).value, 1.1 * mean_of_cells(all.views[2].luminance).value);
}

TEST(TracedViews, AreThoseOfTracesOfTheirOwnByNextEvent) {
  expect_those_of_single_traces("next_event");
}

TEST(TracedViewsLong, AreThoseOfTracesOfTheirOwnByCounting) {
  expect_those_of_single_traces("counting");
}

TEST(TracedViews, WhatCountsIsTheirWeightedSumInEachBatch) {
  const Observation all = observed(kViews, 5, 20'000);
  double shares = 0.0;
  for (const ViewedLuminance& view : all.views) shares += view.share;
  EXPECT_NEAR(shares, 1.0, 1e-12);
  for (const std::size_t batch : {std::size_t{0}, std::size_t{57}}) {
    for (std::size_t cell = 0; cell < 8; ++cell) {
      double sum = 0.0;
      for (const ViewedLuminance& view : all.views) sum += view.share * view.luminance.batch(batch)[cell];
      EXPECT_NEAR(all.luminance.batch(batch)[cell], sum, 1e-9 * sum);
    }
  }
  EXPECT_NEAR(all.map.luminance.values[3], all.luminance.total(3).value * all.luminance_unit, 1e-6);
  EXPECT_EQ(all.map.luminance.values.size(), 8U);
}

/// So the updaters that use histories work on the weighted sum.
TEST(TracedViews, RecordsTellTheWeightedSum) {
  const Observation all = observed(kViews, 6, 20'000, true);
  ASSERT_TRUE(all.records);
  ASSERT_EQ(all.records->photons(), all.photons);
  const core::Tally again = all.records->at(all.records->density()).luminance;
  ASSERT_EQ(again.bins(), 8U);
  for (std::size_t cell = 0; cell < 8; ++cell)
    EXPECT_NEAR(again.total(cell).value, all.luminance.total(cell).value, 1e-5 * all.luminance.total(cell).value);
}

TEST(TracedViews, EachIsJudgedForItself) {
  const Observation all = observed(kViews, 7, 20'000);
  const FinalJudgment judgment = make_judgment(all, {});
  ASSERT_EQ(judgment.views.size(), 3U);
  EXPECT_EQ(judgment.views[2].azimuth_deg, 90.0);
  EXPECT_NEAR(judgment.views[2].polar_deg, 50.0, 1e-9);
  double sum = 0.0;
  for (const ViewJudgment& view : judgment.views) {
    EXPECT_GT(view.rms_corrected.value, 0.02);
    sum += view.share * view.luminance_mean.value;
  }
  EXPECT_NEAR(sum, judgment.luminance_mean.value, 1e-6 * sum);
  EXPECT_TRUE(make_judgment(observed("cone_deg: 20", 7, 20'000), {}).views.empty());
}

}  // namespace
}  // namespace evenglow::design
