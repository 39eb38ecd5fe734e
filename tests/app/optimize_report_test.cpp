#include "app/optimize_report.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/engine/state_file.h"
#include "tests/app/tiny_run.h"

namespace evenglow::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

design::OuterResult result(double value, double efficiency, double rms) {
  return {{value}, {efficiency, 0.001}, {rms, 0.002}, 1000, 1.0};
}

Run run_with_bound(double bound) {
  Run run;
  run.outer.rms = bound;
  run.outer.variables = {{"design.level", 0.1, 0.5, 0.2}};
  return run;
}

/// The verdict of a whole search, its designs judged anew as they were.
OptimizeVerdict verdict_of(const std::vector<design::OuterResult>& results, double bound) {
  OptimizeVerdict verdict = choose_design(results, bound);
  verdict.start = results.front();
  verdict.improved = results[verdict.best];
  return verdict;
}

const std::vector<design::OuterResult> kUneven = {result(0.2, 0.60, 0.44), result(0.3, 0.70, 0.42),
                                                  result(0.4, 0.90, 0.43)};
const std::vector<design::OuterResult> kSome = {result(0.2, 0.60, 0.05), result(0.3, 0.62, 0.019),
                                                result(0.4, 0.64, 0.0215), result(0.5, 0.90, 0.0225)};

TEST(OptimizeReport, TheBestKeepsTheBoundWithinAStandardError) {
  const OptimizeVerdict verdict = choose_design(kSome, 0.02);
  EXPECT_TRUE(verdict.feasible);
  EXPECT_EQ(verdict.best, 2u) << "the last one, beyond the bound by little, is more efficient";
}

TEST(OptimizeReport, WhenNoneKeepsTheBoundTheNearestIsToldAsSuch) {
  const app::Run run = run_with_bound(0.02);
  const OptimizeVerdict verdict = verdict_of(kUneven, 0.02);
  EXPECT_FALSE(verdict.feasible);
  EXPECT_EQ(verdict.best, 1u);
  const design::Study study = optimize_study(run, "", kUneven, verdict);
  EXPECT_THAT(study.notes.front(), HasSubstr("No design keeps the bound of 2 %; the nearest is design.level = 0.3."));
  EXPECT_THAT(design::study_html(study), HasSubstr("No design keeps the bound of 2 %"));
  EXPECT_THAT(design::study_html(study), Not(HasSubstr("best that keeps")));
  EXPECT_EQ(study.rows[1].back(), "nearest");
  EXPECT_EQ(study.plots[0].curves.size(), 1u);
  const tests::TempFolder folder;
  write_optimize(study, run, kUneven, verdict, folder.path());
  EXPECT_EQ(tests::json_of(folder / "optimize.json")["feasible"], false);
}

TEST(OptimizeReport, TheCurveOfTheBestBeginsWhereADesignKeepsTheBound) {
  const app::Run run = run_with_bound(0.02);
  const OptimizeVerdict verdict = verdict_of(kSome, 0.02);
  const design::Study study = optimize_study(run, "", kSome, verdict);
  ASSERT_EQ(study.plots[0].curves.size(), 2u);
  EXPECT_THAT(study.plots[0].curves[1].x, ::testing::ElementsAre(1.0, 2.0, 3.0));
  EXPECT_THAT(study.plots[0].curves[1].y, ::testing::ElementsAre(62.0, 64.0, 64.0));
  EXPECT_THAT(study.notes.front(), HasSubstr("Best: design.level = 0.4."));
  const tests::TempFolder folder;
  write_optimize(study, run, kSome, verdict, folder.path());
  EXPECT_EQ(tests::json_of(folder / "optimize.json")["feasible"], true);
}

TEST(OptimizeReport, ABestThatFailsTheBoundWhenJudgedAnewIsTold) {
  OptimizeVerdict verdict = verdict_of(kSome, 0.02);
  verdict.improved.rms.value = 0.03;
  EXPECT_THAT(optimize_study(run_with_bound(0.02), "", kSome, verdict).notes.front(),
              HasSubstr("it does not keep the bound of 2 %."));
}

/// Anyone can make a state with a right checksum.
TEST(OptimizeReport, StatesOfFiguresThatNoDesignHasAreRefused) {
  const auto told_of = [&](const design::OuterResult& design) -> std::string {
    const tests::TempFolder folder;  // of its own: else the good state before would be taken
    design::save_state(folder / "state.json", optimize_state("me", {design}));
    std::string note;
    try {
      read_optimize_state(folder / "state.json", "me", note);
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_EQ(told_of(result(0.2, 0.6, -0.01)), "");  // a signed root of a square below the noise
  for (const design::OuterResult& wrong : {result(0.2, -0.6, 0.1), result(0.2, 7.0, 0.1), result(0.2, 0.6, 1e9)})
    EXPECT_THAT(told_of(wrong), HasSubstr("figures out of range"));
  design::OuterResult wrong = result(0.2, 0.6, 0.1);
  wrong.rms.se = -1.0;
  EXPECT_THAT(told_of(wrong), HasSubstr("figures out of range"));
}

}  // namespace
}  // namespace evenglow::app
