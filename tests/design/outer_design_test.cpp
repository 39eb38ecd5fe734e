#include "design/engine/outer_design.h"

#include <cmath>
#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/core/config_reading.h"

namespace evenglow::design {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

/// Efficiency has its top of 0.7 at (0.08, 0.8); the RMS passes 2 % where the first variable is above 0.07.
OuterResult smooth(const std::vector<double>& v, double noise, std::mt19937_64& random) {
  std::normal_distribution<double> normal(0.0, noise);
  OuterResult r;
  r.values = v;
  r.efficiency = {0.7 - 8.0 * std::pow(v[0] - 0.08, 2) - 0.5 * std::pow(v[1] - 0.8, 2) + normal(random), noise};
  r.rms = {v[0] < 0.07 ? 0.01 : 0.01 + (v[0] - 0.07), 0.0};
  r.photons = 1000;
  return r;
}

OuterSpec spec_of(const std::string& method) {
  OuterSpec spec;
  spec.variables = {{"a", 0.01, 0.2, 0.03, false}, {"b", 0.5, 1.0, 0.6, false}};
  spec.method = method;
  spec.evaluations = 60;
  spec.rms = 0.02;
  return spec;
}

class OuterDesign : public testing::TestWithParam<std::string> {};

TEST_P(OuterDesign, FindsTheTopThatKeepsTheBound) {
  for (const double noise : {0.0, 1e-4}) {
    std::mt19937_64 random(4);
    const OuterSpec spec = spec_of(GetParam());
    const auto results =
        run_outer([&](const auto& v) { return std::optional(smooth(v, noise, random)); }, spec, {}, [](const auto&) {});
    ASSERT_TRUE(results);
    const OuterResult& best = (*results)[best_of(*results, spec.rms)];
    EXPECT_GT(best.efficiency.value, 0.695) << noise;
    EXPECT_LE(best.rms.value, 0.0205);
    EXPECT_LE(results->size(), 60U);
  }
}

TEST_P(OuterDesign, GoesOnFromWhatIsKnown) {
  std::mt19937_64 random(4);
  const OuterSpec spec = spec_of(GetParam());
  int calls = 0;
  const OuterModel model = [&](const auto& v) {
    ++calls;
    return std::optional(smooth(v, 0.0, random));
  };
  const auto whole = run_outer(model, spec, {}, [](const auto&) {});
  std::vector<OuterResult> known(whole->begin(), whole->begin() + 7);
  const int before = calls;
  const auto rest = run_outer(model, spec, known, [](const auto&) {});
  EXPECT_EQ(calls - before, static_cast<int>(whole->size()) - 7);
  ASSERT_EQ(rest->size(), whole->size());
  for (std::size_t i = 0; i < whole->size(); ++i) EXPECT_EQ((*rest)[i].values, (*whole)[i].values);
}
INSTANTIATE_TEST_SUITE_P(Methods, OuterDesign, testing::Values("cobyla", "bobyqa", "sbplx"),
                         [](const auto& name) { return name.param; });

TEST(OuterDesign, KeepsItsBudget) {
  std::mt19937_64 random(4);
  OuterSpec spec = spec_of("cobyla");
  spec.evaluations = 5;
  const OuterModel model = [&](const auto& v) { return std::optional(smooth(v, 0.0, random)); };
  EXPECT_EQ(run_outer(model, spec, {}, [](const auto&) {})->size(), 5U);
  spec.evaluations = 100;
  spec.photons = 8000;
  EXPECT_EQ(run_outer(model, spec, {}, [](const auto&) {})->size(), 8U);
}

TEST(OuterDesign, WholeNumbersAreDesignedOnce) {
  OuterSpec spec = spec_of("cobyla");
  spec.variables = {{"count", 4, 20, 6, true}};
  std::vector<double> seen;
  const OuterModel model = [&](const std::vector<double>& v) {
    seen.push_back(v[0]);
    OuterResult r;
    r.values = v;
    r.efficiency = {-std::abs(v[0] - 13.0), 0.0};
    return std::optional(r);
  };
  const auto results = run_outer(model, spec, {}, [](const auto&) {});
  for (std::size_t i = 0; i < seen.size(); ++i) {
    EXPECT_EQ(seen[i], std::round(seen[i]));
    EXPECT_EQ(std::count(seen.begin(), seen.end(), seen[i]), 1);
  }
  EXPECT_EQ((*results)[best_of(*results, spec.rms)].values[0], 13.0);
}

TEST(OuterDesign, IsEmptyWhenInterrupted) {
  EXPECT_FALSE(
      run_outer([](const auto&) { return std::optional<OuterResult>(); }, spec_of("cobyla"), {}, [](const auto&) {}));
}

core::Lines faults(const std::string& text, OuterSpec* spec = nullptr) {
  return core::faults_of(text, [&](const core::ConfigNode& root) {
    const OuterSpec read = read_outer(root);
    if (spec != nullptr) *spec = read;
  });
}

TEST(OuterKeys, AreReadInEitherSpelling) {
  OuterSpec spec;
  EXPECT_THAT(faults("optimise: [{key: design.level, range: [0.05, 0.2], start: 0.1}]\n"
                     "optimizer: {method: sbplx, evaluations: 9, photons: 1e9, rms: 0.01}\n",
                     &spec),
              IsEmpty());
  ASSERT_EQ(spec.variables.size(), 1U);
  EXPECT_EQ(spec.variables[0].key, "design.level");
  EXPECT_EQ(spec.variables[0].start, 0.1);
  EXPECT_EQ(spec.photons, 1e9);
  EXPECT_THAT(faults("optimize: [{key: a, range: [1, 2]}]\n", &spec), IsEmpty());
  EXPECT_EQ(spec.variables[0].start, 1.5);
  EXPECT_THAT(faults("optimize: [{key: a, range: [2, 1]}]\n"), testing::Contains(HasSubstr("least < largest")));
  EXPECT_THAT(faults("optimize: [{key: a, range: [1, 2], start: 3}]\n"),
              ElementsAre(HasSubstr("must lie in the range")));
  EXPECT_THAT(faults("{}\n", &spec), IsEmpty());
  EXPECT_TRUE(spec.variables.empty());
}

/// What a design fails with is told, not that the search did.
TEST_P(OuterDesign, AFailureIsPassedOn) {
  int made = 0;
  const OuterModel model = [&](const std::vector<double>& v) -> std::optional<OuterResult> {
    if (++made == 4) throw core::Error("the disk is full");
    std::mt19937_64 random(1);
    return smooth(v, 0.0, random);
  };
  try {
    run_outer(model, spec_of(GetParam()), {}, [](const auto&) {});
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_STREQ(error.what(), "the disk is full");
  }
  EXPECT_EQ(made, 4);
}

}  // namespace
}  // namespace evenglow::design
