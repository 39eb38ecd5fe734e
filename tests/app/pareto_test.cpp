#include <chrono>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// `evenglow pareto`, `evenglow bench-design`, and the goals, starts and targets of `evenglow design`.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

class Studies : public ::testing::Test {
 protected:
  Studies() { write_text(folder_ / "tiny.yaml", kTinyRun); }
  ProgramResult run(std::vector<std::string> words) const {
    words.push_back("--quiet");
    return evenglow(words, folder_.path());
  }
  TempFolder folder_;
};

TEST_F(Studies, ParetoKeepsEachPoint) {
  const ProgramResult result =
      run({"pareto", "tiny.yaml", "-o", "front", "--set", "design.pareto_levels=[0.05, 0.1, 0.2]"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder_ / "front" / "pareto.json");
  ASSERT_EQ(json["points"].size(), 3U);
  EXPECT_EQ(json["points"][2]["level"], 0.2);
  for (const auto& point : json["points"]) {
    EXPECT_GT(point["efficiency"].get<double>(), 0.1);
    EXPECT_LE(point["rms_95_low"].get<double>(), point["rms_95_high"].get<double>());
    EXPECT_TRUE(std::filesystem::exists(folder_ / "front" / point["density"].get<std::string>()));
  }
  for (const char* name : {"pareto.csv", "pareto.html", "pareto.png", "luminance_03.csv"})
    EXPECT_FALSE(file_text(folder_ / "front" / name).empty()) << name;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "front" / "checkpoint.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "front" / "checkpoint_2.json"));
  EXPECT_EQ(run({"pareto", "tiny.yaml", "-o", "front"}).code, 2) << "another result is not replaced unasked";
}

/// The goal max_efficiency keeps a state for each point: all of them stay until the results are there, and none stays
/// of a run that was begun anew.
TEST_F(Studies, StatesOfPointsStayUntilResultsAreThere) {
  const std::vector<std::string> command = {
      "design", "tiny.yaml", "-o", "best", "--set", "design.goal=max_efficiency", "--set", "design.subject_to.rms=0.2"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), command.begin(), command.end());
    return run(more);
  };
  // A folder in the way of a result: the designs were made, writing them fails.
  std::filesystem::create_directories(folder_ / "best" / "report.html" / "full");
  const ProgramResult failed = with({"--overwrite"});
  ASSERT_EQ(failed.code, 1) << failed.err;
  EXPECT_THAT(failed.err, HasSubstr("the state is kept"));
  ASSERT_TRUE(std::filesystem::exists(folder_ / "best" / "checkpoint_1.json"));
  std::filesystem::remove_all(folder_ / "best" / "report.html");
  const std::string second = file_text(folder_ / "best" / "checkpoint_1.json");
  const ProgramResult again = with({"--resume"});
  ASSERT_EQ(again.code, 0) << again.err;
  EXPECT_FALSE(std::filesystem::exists(folder_ / "best" / "checkpoint_1.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "best" / "checkpoint.json"));
  // States that an earlier run left, of more points than this one reaches, which is stopped before its end.
  constexpr int kMany = 30;
  const auto state = [&](int point) { return folder_ / "best" / ("checkpoint_" + std::to_string(point) + ".json"); };
  for (int point = 1; point <= kMany; ++point) write_text(state(point), second);
  std::filesystem::remove(folder_ / "best" / "report.html");
  std::filesystem::create_directories(folder_ / "best" / "report.html" / "full");
  ASSERT_EQ(with({"--overwrite", "--seed", "7"}).code, 1);
  EXPECT_TRUE(std::filesystem::exists(state(1)));
  EXPECT_FALSE(std::filesystem::exists(state(kMany)));
}

TEST_F(Studies, BenchDesignComparesUpdaters) {
  const ProgramResult result =
      run({"bench-design", "tiny.yaml", "-o", "bench", "--seeds", "2", "--updaters", "ratio,auto", "--photons", "2e4"});
  ASSERT_EQ(result.code, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("photons (millions)"));
  const auto json = json_of(folder_ / "bench" / "bench.json");
  EXPECT_EQ(json["cases"][0]["median_low_high"].size(), 8U);
  for (const char* name : {"bench.csv", "bench.txt", "bench.html", "bench.png"})
    EXPECT_FALSE(file_text(folder_ / "bench" / name).empty()) << name;
  const ProgramResult wrong = run({"bench-design", "tiny.yaml", "--updaters", "newton"});
  EXPECT_EQ(wrong.code, 2);
  EXPECT_THAT(wrong.err, HasSubstr("--updaters: must be among auto"));
}

TEST_F(Studies, OptimizeTurnsScalarKeys) {
  write_text(folder_ / "outer.yaml", std::string(kTinyRun) +
                                         "optimize:\n  - {key: design.level, range: [0.05, 0.3]}\n"
                                         "  - {key: \"backlight.films[0].haze\", range: [0.5, 0.95]}\n"
                                         "optimizer: {evaluations: 4, rms: 0.2}\n");
  const ProgramResult result = run({"optimize", "outer.yaml", "-o", "outer"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder_ / "outer" / "optimize.json");
  ASSERT_EQ(json["designs"].size(), 4U);
  EXPECT_EQ(json["designs"][0]["values"][0], 0.175);
  EXPECT_GT(json["judged_anew"]["best"]["efficiency"].get<double>(), 0.1);
  for (const char* name : {"optimize.csv", "optimize.html", "optimize.png", "density.csv"})
    EXPECT_FALSE(file_text(folder_ / "outer" / name).empty()) << name;
  const ProgramResult none = run({"optimize", "tiny.yaml"});
  EXPECT_EQ(none.code, 2);
  EXPECT_THAT(none.err, HasSubstr("optimize: must be a list"));
}

/// Designs of another backlight must not be compared with those before.
TEST_F(Studies, OptimizeStopsWhereAFileChangesOnTheWay) {
  std::string text = kTinyRun;
  const std::string films = "  films: ";
  const std::size_t at = text.find(films);
  const std::string line = text.substr(at, text.find('\n', at) - at);
  text.erase(at, line.size() + 1);
  text.replace(text.find("backlight:\n"), 11, "backlight:\n  include: part.yaml\n");
  write_text(folder_ / "part.yaml", line.substr(2) + "\n");
  write_text(folder_ / "outer.yaml", text +
                                         "optimize:\n  - {key: design.level, range: [0.05, 0.3]}\n"
                                         "optimizer: {evaluations: 6, rms: 0.2}\n");
  Program program(words_of(EVENGLOW_PROGRAM, {"optimize", "outer.yaml", "-o", "outer", "--quiet"}), folder_.path());
  while (program.is_running() && !std::filesystem::exists(folder_ / "outer" / "checkpoint.json"))
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  write_text(folder_ / "part.yaml", line.substr(2) + "  # changed\n");
  const ProgramResult result = program.wait(60);
  EXPECT_EQ(result.code, 2);
  EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
  EXPECT_THAT(result.err, HasSubstr("outer.yaml: must stay as it was until the search has ended"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "outer" / "optimize.json"));
}

/// A title is of the file, and so of anyone: nothing of it steers the terminal.
TEST_F(Studies, TitlesSteerNoTerminal) {
  const std::vector<std::string> title = {"--set", "title=\"x\\e[31mRED\"", "--quiet", "-o"};
  for (const std::string command : {"simulate", "design", "pareto", "optimize"}) {
    std::vector<std::string> words = {command, "tiny.yaml"};
    words.insert(words.end(), title.begin(), title.end());
    words.push_back("t_" + command);
    if (command == "optimize") {
      words.insert(words.end(), {"--set", "optimize=[{key: design.level, range: [0.05, 0.3]}]", "--set",
                                 "optimizer={evaluations: 2}"});
    }
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 0) << result.err;
    EXPECT_THAT(result.out, HasSubstr("RED")) << command;
    EXPECT_THAT(result.out, ::testing::Not(HasSubstr("\x1b"))) << command;
  }
}

TEST_F(Studies, MaxEfficiencyTellsEveryLevelItTried) {
  const ProgramResult result = run({"design", "tiny.yaml", "-o", "out", "--set", "design.goal=max_efficiency", "--set",
                                    "design.subject_to={rms: 0.3}"});
  ASSERT_EQ(result.code, 0) << result.err;
  const auto json = json_of(folder_ / "out" / "result.json");
  EXPECT_THAT(json["stop_reason"].get<std::string>(), HasSubstr("max_efficiency: the best of"));
  EXPECT_LT(json["final"]["rms_corrected"].get<double>(), 0.35);
  int levels = 0;
  for (const auto& note : json["notes"]) levels += note.get<std::string>().starts_with("Level ") ? 1 : 0;
  EXPECT_GE(levels, 2);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "checkpoint_1.json"));
}

/// Corrected RMS of the first step, from 2e5 photons, of a plate that is long enough to darken along its way.
class FirstStep : public Studies {
 protected:
  double of(const std::string& out, const std::vector<std::string>& more) const {
    std::vector<std::string> words = {"design", "tiny.yaml", "-o", out, "--photons", "2e5"};
    for (const std::string change : {"design.first_photons=2e5", "design.level=0.2", "design.max_steps=2",
                                     "backlight.light_guide_plate.length_mm=100"}) {
      words.insert(words.end(), {"--set", change});
    }
    words.insert(words.end(), more.begin(), more.end());
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 0) << result.err;
    return json_of(folder_ / out / "result.json")["steps"][0]["rms_corrected"].get<double>();
  }
};

TEST_F(FirstStep, OfAWarmStartBeginsWhereAnotherResultEnded) {
  const double cold = of("cold", {});
  const double warm =
      of("warm", {"--set", "design.start={result: cold}", "--set", "backlight.microstructure.cells=[12, 6]"});
  EXPECT_LT(warm, 0.6 * cold);
}

TEST_F(FirstStep, OfAnAnalyticStartIsMoreEvenThanThatOfAFlatOne) {
  EXPECT_LT(of("analytic", {"--set", "design.start=analytic"}), 0.6 * of("flat", {}));
}

}  // namespace
}  // namespace evenglow::tests
