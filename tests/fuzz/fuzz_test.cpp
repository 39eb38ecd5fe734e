#include <gtest/gtest.h>

#include "tests/fuzz/fuzz_run.h"
#include "tests/fuzz/mutator.h"

/// A short run over every reader of strangers' files; `./test fuzz` makes a long one.
namespace evenglow::tests {
namespace {

class Fuzz : public ::testing::TestWithParam<std::size_t> {};

TEST_P(Fuzz, ADamagedFileIsTakenOrRefusedInOneLine) {
  const FuzzTarget& target = fuzz_targets()[GetParam()];
  bool accepted = false;
  std::size_t good = 0;
  for (const std::string& seed : target.seeds) {
    EXPECT_EQ(read_one(target, seed, accepted), "");
    good += accepted ? 1 : 0;
  }
  EXPECT_GT(good, 0u) << "damage to files that are refused anyway shows little";
  const FuzzOutcome outcome = fuzz(target, 20260101, 0.5, 20.0);
  EXPECT_EQ(outcome.finding, "") << outcome.input.substr(0, 2000);
  EXPECT_GT(outcome.executions, 0u);
}

INSTANTIATE_TEST_SUITE_P(Targets, Fuzz, ::testing::Range(std::size_t{0}, fuzz_targets().size()),
                         [](const ::testing::TestParamInfo<std::size_t>& target) {
                           return fuzz_targets()[target.param].name;
                         });

TEST(Mutator, TheSameSeedGivesTheSameFiles) {
  Mutator one(5), two(5), other(6);
  const std::vector<std::string> seeds = {"abc: 12.5\n", "second: [1, 2]\n"};
  bool differs = false;
  for (int i = 0; i < 50; ++i) {
    const std::string text = one.next(seeds);
    EXPECT_EQ(text, two.next(seeds));
    differs = differs || text != other.next(seeds);
  }
  EXPECT_TRUE(differs);
}

TEST(FuzzRun, WhatIsThrownBesidesErrorsOfTheInputIsAFinding) {
  const FuzzTarget bad{"bad", {"abc"}, [](std::string_view bytes) {
                         if (bytes != "abc") throw std::out_of_range("a slip");
                       }};
  const FuzzOutcome outcome = fuzz(bad, 1, 5.0, 5.0);
  EXPECT_EQ(outcome.finding, "threw a slip");
  EXPECT_NE(outcome.input, "abc");
}

}  // namespace
}  // namespace evenglow::tests
