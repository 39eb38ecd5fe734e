#include "app/batch_job.h"

#include <algorithm>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/batch_fixture.h"

/// A batch on its way: stopped, killed, gone on with.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

using Words = std::vector<std::string>;

class BatchJobs : public BatchFixture {};

TEST_F(BatchJobs, ARunThatFailsDoesNotStopTheOthers) {
  // Nothing passes a reflector at the top: the design cannot start.
  write_text(folder_ / "tiny.yaml",
             base_ + "sweep: {list: [{backlight.reflectors.top: {kind: mirror}}, {trace.seed: 3}]}\n");
  const ProgramResult result = run({"batch", "tiny.yaml", "-o", "out", "--quiet"});
  EXPECT_EQ(result.code, 1) << result.err;
  const auto table = summary("out");
  EXPECT_EQ(table["runs"][0]["status"], "failed");
  EXPECT_THAT(table["runs"][0]["message"].get<std::string>(), HasSubstr("no light reached"));
  EXPECT_EQ(table["runs"][1]["status"], "done");
}

TEST_F(BatchJobs, AnInterruptedBatchGoesOnAndMakesNothingTwice) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 2, 3, 4]}}\n");
  const Words words = {"batch", "tiny.yaml", "-o", "out", "--simulate", "--photons", "4e5"};
  Program program(words_of(EVENGLOW_PROGRAM, words), folder_.path());
  const auto first = folder_ / "out" / "p1_seed-1" / "result.json";
  while (program.is_running() && !std::filesystem::exists(first)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  program.send(SIGINT);
  EXPECT_EQ(program.wait(60).code, 130);
  const std::size_t before = done(summary("out"));
  EXPECT_GE(before, 1u);
  ASSERT_LT(before, 4u);
  const auto written = std::filesystem::last_write_time(first);
  EXPECT_EQ(run(words).code, 2) << "a batch is not begun anew unasked";
  Words resume = words;
  resume.push_back("--resume");
  const ProgramResult result = run(resume);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("p1_seed-1: done before"));
  EXPECT_EQ(std::filesystem::last_write_time(first), written);
  EXPECT_EQ(done(summary("out")), 4u);
}

TEST_F(BatchJobs, AKilledBatchKnowsEachRunThatIsDoneThoughItsPagesWait) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 2, 3, 4]}}\n");
  const Words words = {"batch", "tiny.yaml", "-o", "out", "--simulate", "--photons", "4e5"};
  const auto start = std::chrono::steady_clock::now();
  Program program(words_of(EVENGLOW_PROGRAM, words), folder_.path());
  const auto known = [&] {
    return std::filesystem::exists(folder_ / "out" / "batch.json") && done(summary("out")) > 0;
  };
  while (program.is_running() && !known()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGKILL);
  program.wait(60);
  const bool at_once = std::chrono::steady_clock::now() - start < std::chrono::seconds(2);
  ASSERT_LT(done(summary("out")), 4u);
  if (at_once) {
    EXPECT_THAT(file_text(folder_ / "out" / "batch.csv"), ::testing::Not(HasSubstr(",done,")));
  }
  Words resume = words;
  resume.push_back("--resume");
  const ProgramResult result = run(resume);
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.err, HasSubstr("p1_seed-1: done before"));
  EXPECT_THAT(file_text(folder_ / "out" / "batch.csv"), ::testing::Not(HasSubstr(",waiting,")));
}

TEST_F(BatchJobs, AResumedBatchMakesChangedRunsAnew) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 2]}}\n");
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  const ProgramResult other = run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--resume", "--photons", "3e4"});
  EXPECT_EQ(other.code, 0) << other.err;
  EXPECT_THAT(other.err, ::testing::Not(HasSubstr("done before")));
  EXPECT_EQ(summary("out")["runs"][0]["final"]["photons"], 30000);
}

/// What was done is in the summary from the first moment on, whatever ends the batch that goes on.
TEST_F(BatchJobs, GoingOnForgetsNothingWhenItEndsAtOnce) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 2]}}\n");
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  std::filesystem::remove(folder_ / "out/batch.html");
  std::filesystem::create_directories(folder_ / "out/batch.html/in_the_way");  // so the pages cannot be written
  EXPECT_NE(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet", "--resume"}).code, 0);
  EXPECT_EQ(done(summary("out")), 2u);
}

TEST_F(BatchJobs, ADamagedSummaryIsRefused) {
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  write_text(folder_ / "out" / "batch.json", "{\"format\": \"evenglow-batch/1\", \"runs\": 3}");
  const ProgramResult result = run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--resume"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("out/batch.json: it has no checksum"));
}

TEST_F(BatchJobs, AnAlteredSummaryIsNotBelieved) {
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  std::string text = file_text(folder_ / "out" / "batch.json");
  const std::string key = "\"luminance_mean_cd_m2\": ";
  ASSERT_NE(text.find(key), std::string::npos);
  text.insert(text.begin() + static_cast<std::ptrdiff_t>(text.find(key) + key.size()), '9');
  write_text(folder_ / "out" / "batch.json", text);
  const ProgramResult result = run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--resume"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("out/batch.json: its checksum is wrong"));
}

TEST_F(BatchJobs, ARunWhoseResultHasGoneIsMadeAnew) {
  const Words words = {"batch", "tiny.yaml", "-o", "out", "--simulate", "--resume"};
  ASSERT_EQ(run(words).code, 0);
  EXPECT_THAT(run(words).err, HasSubstr("tiny: done before"));
  std::filesystem::remove(folder_ / "out/tiny/result.json");
  const ProgramResult again = run(words);
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, ::testing::Not(HasSubstr("done before")));
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out/tiny/result.json"));
}

/// The second run would be of another backlight than the first, and than the plan.
TEST_F(BatchJobs, AFileThatChangesOnTheWayFailsItsRuns) {
  write_text(folder_ / "part.yaml", "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}\n");
  std::string text = base_ + "sweep: {grid: {trace.seed: [1, 2]}}\n";
  const std::string plate = "  light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.6}\n";
  text.replace(text.find(plate), plate.size(), "  include: part.yaml\n");
  write_text(folder_ / "tiny.yaml", text);
  Program program(
      words_of(EVENGLOW_PROGRAM, {"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet", "--photons", "4e5"}),
      folder_.path());
  while (program.is_running() && !std::filesystem::exists(folder_ / "out" / "p1_seed-1"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  write_text(folder_ / "part.yaml", "light_guide_plate: {length_mm: 20, width_mm: 10, thickness_mm: 0.5}\n");
  const ProgramResult result = program.wait(60);
  EXPECT_EQ(result.code, 1);
  const auto table = summary("out");
  EXPECT_EQ(table["runs"][0]["status"], "done");
  EXPECT_EQ(table["runs"][1]["status"], "failed");
  EXPECT_THAT(table["runs"][1]["message"].get<std::string>(), HasSubstr("has changed since the batch began"));
  EXPECT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet", "--photons", "4e5", "--resume"}).code, 0);
}

TEST_F(BatchJobs, FoldersOfAnEarlierBatchAreTold) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 2]}}\n");
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  EXPECT_TRUE(summary("out")["left_over"].empty());
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {grid: {trace.seed: [1, 3]}}\n");
  for (const char* how : {"--resume", "--overwrite"}) {
    const ProgramResult result = run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet", how});
    ASSERT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("\nnot of this batch: p2_seed-2 (left from an earlier one)\n")) << how;
    EXPECT_EQ(summary("out")["left_over"].dump(), "[\"p2_seed-2\"]");
    EXPECT_THAT(file_text(folder_ / "out/batch.html"), HasSubstr("not of this batch: p2_seed-2"));
    EXPECT_TRUE(std::filesystem::exists(folder_ / "out/p2_seed-2/result.json"));
  }
}

TEST_F(BatchJobs, TracesDoNotGoOnAsDesigns) {
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--quiet"}).code, 0);
  const ProgramResult refused = run({"batch", "tiny.yaml", "-o", "out", "--resume"});
  EXPECT_EQ(refused.code, 2);
  ASSERT_EQ(refused.err_lines().size(), 1u) << refused.err;
  EXPECT_THAT(refused.err, HasSubstr("out/batch.json is of a batch of single traces, go on with --simulate"));
  EXPECT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--resume", "--simulate", "--quiet"}).code, 0);
}

}  // namespace
}  // namespace evenglow::tests
