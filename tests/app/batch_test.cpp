#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/batch_fixture.h"

/// `evenglow batch`: many runs, one summary; what fails does not stop the others, what is done is not done twice.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

using Words = std::vector<std::string>;

class Batch : public BatchFixture {};

TEST_F(Batch, EachPointOfASweepHasAFolderAndARow) {
  write_text(folder_ / "tiny.yaml",
             base_ + "sweep: {grid: {backlight.microstructure.density: [0.1, 0.2], trace.seed: [1, 2]}}\n");
  const ProgramResult result = run({"batch", "tiny.yaml", "--simulate", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("4 of 4 runs done\nfiles: out/tiny"));
  const auto table = summary("out/tiny");
  ASSERT_EQ(table["runs"].size(), 4u);
  EXPECT_EQ(table["runs"][3]["name"], "p4_density-0.2_seed-2");
  EXPECT_EQ(table["runs"][3]["changes"]["trace.seed"], "2");
  for (const auto& row : table["runs"]) {
    const auto place = folder_ / "out/tiny" / row["name"].get<std::string>();
    EXPECT_EQ(row["status"], "done");
    EXPECT_EQ(json_of(place / "result.json")["final"]["efficiency"], row["final"]["efficiency"]);
    EXPECT_TRUE(std::filesystem::exists(place / "thumbnail.png"));
    EXPECT_TRUE(std::filesystem::exists(place / "report.html"));
  }
  const std::string csv = file_text(folder_ / "out/tiny/batch.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 5);
  EXPECT_THAT(csv, HasSubstr("name,file,status,backlight.microstructure.density,trace.seed,rms,"));
  const std::string page = file_text(folder_ / "out/tiny/batch.html");
  EXPECT_THAT(page, HasSubstr("src=\"data:image/png;base64,iVBOR"));
  EXPECT_THAT(page, HasSubstr("href=\"./p4_density-0.2_seed-2/report.html\""));
}

TEST_F(Batch, ARunOfABatchIsTheRunOfItsOwnCommand) {
  write_text(folder_ / "tiny.yaml", base_ + "sweep: {list: [{trace.seed: 5}]}\n");
  ASSERT_EQ(run({"batch", "tiny.yaml", "-o", "all", "--quiet"}).code, 0);
  ASSERT_EQ(run({"design", "tiny.yaml", "-o", "one", "--set", "trace.seed=5", "--quiet"}).code, 0);
  auto in_batch = nlohmann::ordered_json::parse(lasting_part(folder_ / "all/p1_seed-5/result.json"));
  auto alone = nlohmann::ordered_json::parse(lasting_part(folder_ / "one/result.json"));
  EXPECT_EQ(in_batch["final"], alone["final"]);
  EXPECT_EQ(in_batch["steps"], alone["steps"]);
  EXPECT_EQ(file_text(folder_ / "all/p1_seed-5/density.csv"), file_text(folder_ / "one/density.csv"));
}

TEST_F(Batch, WrongRunsAreToldAndPassed) {
  write_text(folder_ / "tiny.yaml",
             base_ + "sweep: {zip: {\"backlight.films[0].haze\": [0.8, 3], trace.seed: [1, 1]}}\n");
  write_text(folder_ / "broken.yaml", "evenglow: 1\nbacklight: [\n");
  const ProgramResult result =
      run({"batch", "tiny.yaml", "broken.yaml", "missing.yaml", "--simulate", "--quiet", "-o", "out"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, HasSubstr("backlight.films[0].haze: must lie in"));
  EXPECT_THAT(result.err, HasSubstr("broken.yaml:"));
  EXPECT_THAT(result.err, HasSubstr("missing.yaml"));
  const auto table = summary("out");
  ASSERT_EQ(table["runs"].size(), 4u);
  EXPECT_EQ(done(table), 1u);
  EXPECT_EQ(table["runs"][1]["status"], "wrong_input");
  EXPECT_THAT(table["runs"][1]["message"].get<std::string>(), HasSubstr("haze"));
  EXPECT_EQ(table["runs"][2]["name"], "broken");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "broken"));
}

TEST_F(Batch, CheckReadsEachRun) {
  write_text(folder_ / "tiny.yaml", base_ +
                                        "sweep: {list: [{trace.seed: 2}, {\"backlight.films[0].haze\": 3}, "
                                        "{backlight.light_guide_plate.end_thickness_mm: 0.4, trace.path: planar}]}\n");
  const ProgramResult result = run({"check", "tiny.yaml"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.out, HasSubstr("tiny.yaml: 1 of 3 runs of the sweep are good"));
  EXPECT_THAT(result.out, HasSubstr("tiny.yaml (run p2_haze-3): wrong"));
  EXPECT_THAT(result.err, HasSubstr("backlight.films[0].haze: must lie in [0, 1], got 3"));
  EXPECT_THAT(result.err, HasSubstr("trace.path: planar is for parallel layers over a flat plate"));
}

TEST_F(Batch, WithNothingRightNothingIsWritten) {
  write_text(folder_ / "broken.yaml", "evenglow: 1\nbacklight: [\n");
  const ProgramResult result = run({"batch", "broken.yaml", "missing.yaml", "-o", "out"});
  EXPECT_EQ(result.code, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out"));
}

TEST_F(Batch, FaultsForProgramsAreJson) {
  write_text(folder_ / "wrong.yaml", base_ + "nonsense: 1\n");
  const std::vector<Words> faulty = {{"batch", "wrong.yaml", "missing.yaml"},
                                     {"design", "wrong.yaml"},
                                     {"simulate", "missing.yaml"},
                                     {"simulate", "tiny.yaml", "--set", "a.b=1"},
                                     {"simulate", "tiny.yaml", "--photonen", "3"},
                                     {"simulate", "tiny.yaml", "-o", "tiny.yaml"}};
  for (Words words : faulty) {
    words.push_back("--json-progress");
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 2);
    ASSERT_FALSE(result.err_lines().empty());
    for (const std::string& line : result.err_lines()) {
      const auto json = nlohmann::json::parse(line, nullptr, false);
      ASSERT_FALSE(json.is_discarded()) << line;
      EXPECT_EQ(json["event"], "fault");
      EXPECT_FALSE(json["text"].get<std::string>().empty());
    }
  }
}

TEST_F(Batch, ProgressForProgramsIsJson) {
  const ProgramResult result = run({"design", "tiny.yaml", "-o", "out", "--json-progress"});
  ASSERT_EQ(result.code, 0) << result.err;
  bool step = false;
  for (const std::string& line : result.err_lines()) {
    const auto json = nlohmann::json::parse(line, nullptr, false);
    ASSERT_FALSE(json.is_discarded()) << line;
    step = step || (json["event"] == "step" && json.contains("rms_corrected_se"));
  }
  EXPECT_TRUE(step);
}

TEST_F(Batch, HostileNamesStayText) {
  write_text(folder_ / "tiny.yaml", base_ + "title2: x\n");
  write_text(folder_ / "<img src=x onerror=alert(1)>.yaml", base_);
  const ProgramResult result =
      run({"batch", "<img src=x onerror=alert(1)>.yaml", "-o", "out", "--simulate", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(file_text(folder_ / "out/batch.html"), ::testing::Not(HasSubstr("<img src=x")));
}

}  // namespace
}  // namespace evenglow::tests
