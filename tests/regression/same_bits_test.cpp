#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// One binary and one run file give the same bits on any number of threads.
namespace evenglow::tests {
namespace {

class SameBits : public ::testing::Test {
 protected:
  SameBits() { write_text(folder_ / "tiny.yaml", kTinyRun); }

  std::filesystem::path run(const std::string& command, const std::string& threads) {
    const std::string out = command + threads;
    const ProgramResult result =
        evenglow({command, "tiny.yaml", "-o", out, "--threads", threads, "--quiet"}, folder_.path());
    EXPECT_EQ(result.code, 0) << result.err;
    return folder_ / out;
  }

  TempFolder folder_;
};

void expect_same_run(const std::filesystem::path& a, const std::filesystem::path& b) {
  EXPECT_EQ(lasting_part(a / "result.json"), lasting_part(b / "result.json"));
  for (const char* name :
       {"luminance.csv", "luminance_se.csv", "density.csv", "angular.csv", "luminance.png", "density.png"}) {
    EXPECT_FALSE(file_text(a / name).empty()) << name;
    EXPECT_EQ(file_text(a / name), file_text(b / name)) << name;
  }
}

TEST_F(SameBits, OfADesignOnOneTwoAndFourThreads) {
  const auto one = run("design", "1");
  EXPECT_EQ(json_of(one / "result.json").at("threads"), 1);
  for (const std::string threads : {"2", "4"}) expect_same_run(one, run("design", threads));
}

TEST_F(SameBits, OfASimulationOnOneAndThreeThreads) {
  expect_same_run(run("simulate", "1"), run("simulate", "3"));
}

TEST_F(SameBits, OfAComparisonOnOneTwoAndFourThreads) {
  const auto one = run("compare", "1");
  for (const std::string threads : {"2", "4"}) {
    const auto other = run("compare", threads);
    EXPECT_EQ(file_text(one / "compare.json"), file_text(other / "compare.json"));
    EXPECT_EQ(file_text(one / "compare.csv"), file_text(other / "compare.csv"));
    for (const char* name : {"lpp", "dbef"}) expect_same_run(one / name, other / name);
  }
}

TEST_F(SameBits, AreOthersForAnotherSeed) {
  const auto one = run("simulate", "1");
  const ProgramResult other =
      evenglow({"simulate", "tiny.yaml", "-o", "other", "--seed", "8", "--quiet"}, folder_.path());
  ASSERT_EQ(other.code, 0) << other.err;
  EXPECT_NE(file_text(one / "luminance.csv"), file_text(folder_ / "other" / "luminance.csv"));
}

}  // namespace
}  // namespace evenglow::tests
