#include "tracer/transport/tracer.h"

#include <atomic>
#include <cmath>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/config/config_node.h"
#include "tests/support/chi_square.h"
#include "tests/support/scenes.h"
#include "tests/support/z_test.h"

namespace evenglow::tests {
namespace {

using namespace tracer;

const std::string kBacklight =
    "light_guide_plate: {length_mm: 20, width_mm: 10}, microstructure: {cells: [8, 4], density: 0.2}, "
    "sources: [{kind: led_row, count: 2}], reflectors: {bottom: {}}, films: [{kind: diffuser}, {kind: dbef}]";

void expect_same(const core::Tally& a, const core::Tally& b) {
  ASSERT_EQ(a.batches(), b.batches());
  for (std::size_t i = 0; i < a.batches(); ++i) EXPECT_EQ(a.batch(i), b.batch(i)) << i;
}

TEST(Trace, SameBitsOnAnyNumberOfThreads) {
  const Traced one(kBacklight, {20'000, 5, 40, 1});
  for (const int threads : {2, 4, 0}) {
    const Traced many(kBacklight, {20'000, 5, 40, threads});
    expect_same(one.result().luminance, many.result().luminance);
    expect_same(one.result().energy, many.result().energy);
    expect_same(one.result().angular, many.result().angular);
    EXPECT_EQ(one.result().events, many.result().events);
  }
}

/// The photons are the same however they are put into batches.
TEST(Trace, TotalsDoNotDependOnTheBatches) {
  const Traced few(kBacklight, {20'000, 5, 10, 1});
  const Traced many(kBacklight, {20'000, 5, 100, 1});
  for (std::size_t bin = 0; bin < few.result().energy.bins(); ++bin) {
    EXPECT_EQ(few.result().energy.total(bin).value, many.result().energy.total(bin).value);
  }
}

/// Different seeds: other numbers, same truth. Pairs of escaped shares and mean luminances of 10 seeds: chi-square of
/// the spread over the standard errors. False alarm 1e-3.
TEST(Trace, SeedsAgreeWithinTheirErrors) {
  constexpr int kSeeds = 10;
  std::vector<core::Estimate> luminance;
  std::vector<double> top;
  for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const Traced traced(kBacklight, {20'000, seed, 50, 1});
    luminance.push_back(traced.mean_luminance());
    top.push_back(traced.escaped(Side::kTop));
  }
  double mean = 0.0, mean_top = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    mean += luminance[static_cast<std::size_t>(i)].value / kSeeds;
    mean_top += top[static_cast<std::size_t>(i)] / kSeeds;
  }
  double chi_luminance = 0.0, chi_top = 0.0;
  for (int i = 0; i < kSeeds; ++i) {
    const auto& L = luminance[static_cast<std::size_t>(i)];
    chi_luminance += std::pow((L.value - mean) / L.se, 2);
    chi_top += std::pow(top[static_cast<std::size_t>(i)] - mean_top, 2) / (mean_top * (1.0 - mean_top / 20'000.0));
  }
  const double chance = sidak(0.5e-3, 2);
  for (const double chi : {chi_luminance, chi_top}) {
    EXPECT_GT(chi_square_tail(chi, kSeeds - 1), chance);
    EXPECT_LT(chi_square_tail(chi, kSeeds - 1), 1.0 - chance);  // not the same photons either
  }
}

TEST(Trace, StreamAndStepAreOtherPhotons) {
  const Scene scene = scene_of(kBacklight);
  const DensityField density = initial_density(scene.spec);
  const auto events = [&](const core::RandomKey& key) {
    TraceOptions options;
    options.photons = 5000;
    options.batches = 10;
    options.key = key;
    options.threads = 1;
    return trace(scene, density, options)->events;
  };
  EXPECT_EQ(events({1, 0, 0}), events({1, 0, 0}));
  EXPECT_NE(events({1, 0, 0}), events({1, 1, 0}));
  EXPECT_NE(events({1, 0, 0}), events({1, 0, 1}));
  EXPECT_NE(events({1, 1, 0}), events({1, 0, 1}));
}

TEST(Trace, TellsProgressAndStops) {
  const Scene scene = scene_of(kBacklight);
  const DensityField density = initial_density(scene.spec);
  TraceOptions options;
  options.photons = 10'000;
  options.batches = 10;
  options.threads = 2;
  std::vector<std::uint64_t> told;
  options.progress = [&](std::uint64_t done) { told.push_back(done); };
  ASSERT_TRUE(trace(scene, density, options));
  ASSERT_EQ(told.size(), 10U);
  EXPECT_EQ(told.back(), 10'000U);
  std::stop_source stop;
  options.stop = stop.get_token();
  options.progress = [&](std::uint64_t) { stop.request_stop(); };
  EXPECT_FALSE(trace(scene, density, options));
}

TEST(Trace, TooManyLostPhotonsAreAnError) {
  const std::string endless =
      "size: {length_mm: 20, width_mm: 10}, reflectors: {bottom: {kind: mirror, reflectance: 1}, top: {kind: mirror, "
      "reflectance: 1}}, "
      "sources: [{kind: beam}]";
  try {
    const Traced traced(endless, {11, 1, 11, 1});
    FAIL() << traced.lost();
  } catch (const core::Error& error) {
    EXPECT_NE(std::string(error.what()).find("11 stuck"), std::string::npos) << error.what();
  }
}

TEST(TraceSpec, ReadsAndRounds) {
  const auto read = [](const std::string& text) {
    const core::ConfigDocument document = core::ConfigDocument::parse("trace: {" + text + "}", "test.yaml");
    const TraceSpec spec = read_trace(document.root().map("trace", "how"));
    document.finish();
    return spec;
  };
  EXPECT_EQ(read("").photons, 20'000'000U);
  EXPECT_EQ(read("photons: 2e6, seed: 7, batches: 30").photons, 2'000'010U);
  EXPECT_EQ(read("photons: 2e6, seed: 7, batches: 30").seed, 7U);
  EXPECT_EQ(whole_batches(1000, 100), 1000U);
  EXPECT_EQ(whole_batches(1001, 100), 1100U);
  EXPECT_THROW(read("photons: 10"), core::ConfigError);
  EXPECT_THROW(read("batches: 3"), core::ConfigError);
  EXPECT_THROW(read("seed: -1"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests
