#include "tests/soak/soak.h"

#include <gtest/gtest.h>

#include "app/key_explorer.h"
#include "tests/soak/run_generator.h"

/// A few random run files; `./test soak` traces many.
namespace evenglow::tests {
namespace {

TEST(RunGenerator, TheSameSeedGivesTheSameFiles) {
  const auto keys = app::explore_keys();
  RunGenerator one(keys, 3), two(keys, 3), other(keys, 4);
  bool differs = false;
  for (int i = 0; i < 20; ++i) {
    const std::string yaml = one.next();
    EXPECT_EQ(yaml, two.next());
    differs = differs || yaml != other.next();
  }
  EXPECT_TRUE(differs);
}

TEST(Soak, RandomRunFilesAreTracedInGoodHealth) {
  SoakOptions options;
  options.photons = 200;
  const SoakOutcome outcome = soak(options, [](std::uint64_t traced) { return traced < 8; });
  for (const std::string& finding : outcome.findings) ADD_FAILURE() << finding;
  EXPECT_EQ(outcome.traced, 8u);
  EXPECT_LT(outcome.refused, 20 * outcome.traced) << "the generator makes few files that are taken";
}

TEST(Soak, GrowthIsThatOfTheLeastMemory) {
  SoakOutcome outcome;
  for (std::size_t i = 0; i < 80; ++i) outcome.resident.push_back(100 + i + (i % 7 == 0 ? 1000 : 0));
  EXPECT_DOUBLE_EQ(outcome.growth(), 160.0 - 120.0);
}

}  // namespace
}  // namespace evenglow::tests
