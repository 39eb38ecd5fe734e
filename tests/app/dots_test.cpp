#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow dots` as a user runs it.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;
using ::testing::SizeIs;

class DotsCommand : public ::testing::Test {
 protected:
  DotsCommand() { write_text(folder_ / "run.yaml", kTinyRun); }
  ProgramResult run(std::vector<std::string> words) const {
    words.insert(words.begin(), "dots");
    return evenglow(words, folder_.path());
  }
  void design() const {
    const auto result =
        evenglow({"design", "run.yaml", "-o", "d", "--quiet", "--set", "design.level=0.1"}, folder_.path());
    ASSERT_EQ(result.code, 0) << result.err;
  }
  TempFolder folder_;
};

TEST_F(DotsCommand, AResultOfBracketsOrOfALinkIsRefused) {
  std::filesystem::create_directories(folder_ / "deep");
  write_text(folder_ / "deep" / "result.json", std::string(8'000'000, '['));
  const auto deep = run({"deep", "--diameter_um", "40"});
  EXPECT_EQ(deep.code, 2);
  EXPECT_THAT(deep.err, HasSubstr("deep/result.json: must be the result of a design, but it nests deeper than 32"));
  std::filesystem::create_directory_symlink("..", folder_ / "deep" / "dots");
  const auto linked = run({"deep", "--diameter_um", "40"});
  EXPECT_EQ(linked.code, 2);
  EXPECT_THAT(linked.err, HasSubstr("deep/dots: must be a directory, got a symbolic link"));
}

TEST_F(DotsCommand, MakesDotsOfADesignAndReadsThemAgain) {
  design();
  const auto placed = run({"d", "--diameter_um", "40", "--panel_pitch_um", "54", "--quiet"});
  ASSERT_EQ(placed.code, 0) << placed.err;
  EXPECT_THAT(placed.err, IsEmpty());
  EXPECT_THAT(placed.out, HasSubstr("no beat"));
  const auto json = json_of(folder_ / "d/dots/dots.json");
  EXPECT_EQ(json["format"], "evenglow-dots/1");
  EXPECT_GT(json["count"], 5000);
  EXPECT_LE(json["cells"]["worst_error_dots"], 1.0);
  EXPECT_GE(json["neighbors"]["least_gap_um"], 10.0 - 1e-6);
  EXPECT_FALSE(json["moire"]["visible"]);
  for (const char* name :
       {"dots.csv", "dots.dxf", "dots.gds", "dots.svg", "dots.png", "dots_zoom.png", "dots_spectrum.png"})
    EXPECT_FALSE(file_text(folder_ / "d/dots" / name).empty()) << name;
  for (const char* name : {"d/dots/dots.csv", "d/dots/dots.dxf"}) {
    const auto imported = run({name, "-o", "again", "--overwrite", "--quiet"});
    ASSERT_EQ(imported.code, 0) << imported.err;
    const auto again = json_of(folder_ / "again/dots.json");
    EXPECT_EQ(again["count"], json["count"]);
    EXPECT_NEAR(again["area_mm2"], json["area_mm2"], 1e-6);
    EXPECT_EQ(file_text(folder_ / "again/dots.csv").substr(200, 4000),
              file_text(folder_ / "d/dots/dots.csv").substr(200, 4000));
  }
}

TEST_F(DotsCommand, WarnsOfALatticeNearThePanelsPitch) {
  design();
  const auto lattice = run({"d", "--mode", "lattice", "--pitch_um", "106", "--diameters_um", "15,95",
                            "--panel_pitch_um", "110", "--quiet", "-o", "lattice", "--accept_shortfall"});
  ASSERT_EQ(lattice.code, 0) << lattice.err;
  EXPECT_THAT(lattice.err, HasSubstr("warning: moire: the pattern's period of 10"));
  EXPECT_TRUE(json_of(folder_ / "lattice/dots.json")["moire"]["visible"]);
}

TEST_F(DotsCommand, WritesTheDotsAsMade) {
  design();
  const auto result =
      run({"d", "--set", "dots.process.bias_um=4", "--set", "dots.process.position_spread_um=1", "--quiet"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder_ / "d/dots/dots.json");
  EXPECT_NEAR(json["made"]["area_ratio"], (64.0 * 64.0) / (60.0 * 60.0), 1e-4);
  EXPECT_THAT(file_text(folder_ / "d/dots/dots_made.csv"), HasSubstr("(as made)"));
}

TEST_F(DotsCommand, RefusesInOneLine) {
  design();
  write_text(folder_ / "bad.csv", "x_mm,y_mm,diameter_um\n1,2,oops\n");
  write_text(folder_ / "dots.txt", "");
  for (const auto& [words, text] : std::vector<std::pair<std::vector<std::string>, std::string>>{
           {{"none"}, "none"},
           {{"bad.csv"}, "bad.csv:2:5: diameter_um"},
           {{"dots.txt"}, "must be a result directory, or dots in a .csv or .dxf file"},
           {{"d", "--mode", "round"}, "dots.mode"},
           {{"d", "--gap_um", "-1"}, "dots.gap_um: must lie in [0, 1000], got -1"},
           {{"d", "--margin_mm", "6"}, "dots.margins: must leave a part of the plate"},
           {{"d", "--diameter_um", "60", "--gap_um", "500"}, "dots: mode: must be able to hold the coverage"},
           {{"d", "--run", "no.yaml"}, "no.yaml"}}) {
    const auto result = run(words);
    EXPECT_EQ(result.code, 2) << text << result.err;
    EXPECT_THAT(result.err, HasSubstr(text));
    EXPECT_THAT(result.out, IsEmpty());
    // Progress lines may stand before the fault.
    EXPECT_LE(result.err_lines().size(), 2u) << result.err;
  }
}

TEST_F(DotsCommand, NeedsTheRunFileOfTheDesign) {
  design();
  write_text(folder_ / "run.yaml", std::string(kTinyRun) + "# changed\n");
  const auto lost = run({"d", "--quiet"});
  EXPECT_EQ(lost.code, 2);
  EXPECT_THAT(lost.err, HasSubstr("must be given by --run"));
  const auto given = run({"d", "--quiet", "--run", "run.yaml"});
  EXPECT_EQ(given.code, 0) << given.err;
  EXPECT_THAT(given.err, HasSubstr("note: run.yaml is not, or no longer, the run file of this design"));
  EXPECT_EQ(run({"d", "--quiet", "--run", "run.yaml"}).code, 2) << "dots are there";
}

TEST_F(DotsCommand, TakesTheMapOfTheRunFile) {
  write_text(folder_ / "run.yaml", std::string(kTinyRun) + "dots: {diameter_um: 35, seed: 4}\n");
  design();
  ASSERT_EQ(run({"d", "--quiet"}).code, 0);
  const auto json = json_of(folder_ / "d/dots/dots.json");
  EXPECT_EQ(json["diameter_um"]["mean"], 35.0);
  EXPECT_EQ(json["seed"], 4);
}

}  // namespace
}  // namespace evenglow::tests
