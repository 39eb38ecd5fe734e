#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `design: {verify: dots}` and `dots_file` as a user meets them.
namespace evenglow::tests {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

class DotsVerify : public ::testing::Test {
 protected:
  DotsVerify() { write_text(folder_ / "run.yaml", kTinyRun); }
  ProgramResult run(std::vector<std::string> words) const { return evenglow(words, folder_.path()); }
  ProgramResult design(std::vector<std::string> more) const {
    std::vector<std::string> words = {"design",  "run.yaml",    "-o",    "d",
                                      "--quiet", "--overwrite", "--set", "design.verify=dots"};
    words.insert(words.end(), more.begin(), more.end());
    return run(words);
  }
  TempFolder folder_;
};

TEST_F(DotsVerify, ADesignIsProvedByItsDotsAndTheyCanBeTracedAgain) {
  const auto result = design({"--set", "dots.diameter_um=40", "--set", "design.verify_rounds=1"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("as dots"));
  const auto json = json_of(folder_ / "d/result.json");
  const auto& dots = json["dots"];
  EXPECT_GE(dots["rounds"].size(), 1U);
  EXPECT_LE(dots["rounds"].size(), 2U);
  EXPECT_EQ(dots["final"]["photons"], json["final"]["photons"]);
  EXPECT_NEAR(dots["luminance_over_density"].get<double>(), 1.0, 0.1);
  EXPECT_THAT(file_text(folder_ / "d/report.html"), HasSubstr("The design as real dots"));
  EXPECT_FALSE(file_text(folder_ / "d/dots_density.csv").empty());
  EXPECT_EQ(json_of(folder_ / "d/dots/dots.json")["count"], dots["dots"]);
  EXPECT_FALSE(file_text(folder_ / "d/dots/dots.gds").empty());
  // The same dots by the key dots_file.
  for (const char* file : {"dots_file=d/dots/dots.csv", "dots_file=d/dots/dots.dxf"}) {
    const auto again = run({"simulate", "run.yaml", "-o", "again", "--quiet", "--overwrite", "--set",
                            std::string("backlight.microstructure.") + file});
    ASSERT_EQ(again.code, 0) << again.err;
    const auto traced = json_of(folder_ / "again/result.json")["final"];
    const double first = dots["final"]["luminance_mean_cd_m2"], second = traced["luminance_mean_cd_m2"];
    const double se =
        std::hypot(dots["final"]["luminance_mean_se"].get<double>(), traced["luminance_mean_se"].get<double>());
    EXPECT_LT(std::abs(first - second), 4.0 * se);
  }
}

TEST_F(DotsVerify, SameBitsOnAnyNumberOfThreads) {
  ASSERT_EQ(design({"--threads", "1"}).code, 0);
  const std::string one = lasting_part(folder_ / "d/result.json"), places = file_text(folder_ / "d/dots/dots.csv");
  ASSERT_EQ(design({"--threads", "3"}).code, 0);
  const auto strip = [](std::string text) { return text.substr(text.find("\"steps\"")); };
  EXPECT_EQ(strip(one), strip(lasting_part(folder_ / "d/result.json")));
  EXPECT_EQ(places, file_text(folder_ / "d/dots/dots.csv"));
}

/// What is seen only when the dots are placed costs the proof, not the design.
TEST_F(DotsVerify, DotsThatCannotBePlacedLeaveTheDesign) {
  const auto result = design({"--set", "dots.diameter_um=1", "--set", "dots.gap_um=0.1", "--set", "design.level=0.3"});
  EXPECT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder_ / "d/result.json");
  EXPECT_FALSE(json.contains("dots"));
  EXPECT_THAT(json["notes"].back().get<std::string>(),
              AllOf(HasSubstr("The dots were not verified"), HasSubstr("50 million dots")));
}

/// The folder `dots` of the result belongs to the result: nothing is written through a link, nothing is replaced
/// unasked, nothing of another design stays in it.
TEST_F(DotsVerify, FolderOfTheDotsBelongsToTheResult) {
  namespace fs = std::filesystem;
  const std::vector<std::string> plain = {"design", "run.yaml", "-o", "d", "--quiet", "--set", "design.verify=dots"};
  fs::create_directories(folder_ / "d");
  fs::create_directories(folder_ / "elsewhere");
  fs::create_directory_symlink(folder_ / "elsewhere", folder_ / "d" / "dots");
  const auto linked = run(plain);
  EXPECT_EQ(linked.code, 2);
  EXPECT_THAT(linked.err, HasSubstr("d/dots: must be a directory, got a symbolic link"));
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
  fs::remove(folder_ / "d" / "dots");
  fs::create_directories(folder_ / "d" / "dots");
  write_text(folder_ / "d" / "dots" / "dots.csv", "mine");
  const auto held = run(plain);
  EXPECT_EQ(held.code, 2);
  EXPECT_THAT(held.err, HasSubstr("must not hold another result, got dots/dots.csv"));
  EXPECT_EQ(file_text(folder_ / "d" / "dots" / "dots.csv"), "mine");
  ASSERT_EQ(design({}).code, 0);
  EXPECT_NE(file_text(folder_ / "d" / "dots" / "dots.csv"), "mine");
  write_text(folder_ / "d" / "dots" / "notes.txt", "of the user");
  ASSERT_EQ(run({"design", "run.yaml", "-o", "d", "--quiet", "--overwrite"}).code, 0);
  EXPECT_FALSE(fs::exists(folder_ / "d" / "dots" / "dots.gds")) << "of another design than the result";
  EXPECT_EQ(file_text(folder_ / "d" / "dots" / "notes.txt"), "of the user");
}

/// A folder stands where a file of the dots must go: the design is not lost.
TEST_F(DotsVerify, DotsThatCannotBeWrittenKeepTheState) {
  std::filesystem::create_directories(folder_ / "d" / "dots" / "dots.gds" / "full");
  const auto failed = design({});
  EXPECT_EQ(failed.code, 1);
  EXPECT_THAT(failed.err, AllOf(HasSubstr("dots.gds"), HasSubstr("(the state is kept: --resume")));
  std::filesystem::remove_all(folder_ / "d" / "dots" / "dots.gds");
  const auto again = run({"design", "run.yaml", "-o", "d", "--quiet", "--resume", "--set", "design.verify=dots"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(file_text(folder_ / "d" / "dots" / "dots.gds").empty());
}

TEST_F(DotsVerify, DotsOfABatchNameTheirRunFile) {
  write_text(folder_ / "other.yaml", kTinyRun);
  const auto result = run({"batch", "run.yaml", "other.yaml", "-o", "b", "--quiet", "--set", "design.verify=dots"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(json_of(folder_ / "b/other_lpp/dots/dots.json")["run_file"], "other.yaml");
  EXPECT_EQ(json_of(folder_ / "b/run_dbef/dots/dots.json")["run_file"], "run.yaml");
}

TEST_F(DotsVerify, ZonesThatLeaveNothingAreToldBeforeAnyPhoton) {
  const auto result = design({"--set", "dots.keep_out=[{kind: rectangle, x_mm: [0, 20], y_mm: [0, 10]}]"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("keep_out: must leave a part of the plate"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "d"));
}

TEST_F(DotsVerify, WrongInputIsOneLineBeforeAnyPhoton) {
  const auto expect_fault = [&](const std::vector<std::string>& more, const std::string& text) {
    const auto result = design(more);
    EXPECT_EQ(result.code, 2) << text;
    EXPECT_THAT(result.err, HasSubstr(text));
  };
  const std::string shape = "backlight.microstructure.kind=";
  expect_fault({"--set", shape + "v_groove"}, "design.verify: dots is for shapes that stand as dots");
  expect_fault({"--set", shape + "cone", "--set", "dots.footprint=square"}, "needs the footprint of the shape cone");
  expect_fault({"--set", "dots.margins.left_mm=30"}, "dots.margins: must leave a part of the plate");
  expect_fault({"--set", "dots.gap_um=900"}, "dots needs dots that can hold the least density");
  expect_fault({"--set", "design.goal=max_efficiency"}, "is for the goals even and min_rms");
  expect_fault({"--set", "design.verify_rounds=-1"}, "design.verify_rounds");
}

TEST_F(DotsVerify, DotsFilesAreNotDesignedNorTracedByTheWavefront) {
  write_text(folder_ / "dots.csv", "x_mm,y_mm,diameter_um\n5,5,100\n");
  const std::string file = "backlight.microstructure.dots_file=dots.csv";
  const auto designed = run({"design", "run.yaml", "-o", "d", "--quiet", "--set", file});
  EXPECT_EQ(designed.code, 2);
  EXPECT_THAT(designed.err, HasSubstr("dots_file: must be left out for a design"));
  const auto wave = run({"simulate", "run.yaml", "-o", "w", "--quiet", "--set", file, "--set", "trace.path=wavefront"});
  EXPECT_EQ(wave.code, 2);
  EXPECT_THAT(wave.err, AllOf(HasSubstr("trace.path"), HasSubstr("dots_file")));
}

}  // namespace
}  // namespace evenglow::tests
