#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// Interrupted runs: nothing whole is lost, and what goes on ends in the same bits.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

using Words = std::vector<std::string>;

/// Whether the checkpoint tells of at least `steps` steps.
bool has_steps(const std::filesystem::path& checkpoint, std::size_t steps) {
  const auto state = nlohmann::json::parse(file_text(checkpoint), nullptr, false);
  return !state.is_discarded() && state.contains("steps") && state["steps"].size() >= steps;
}

bool has_ended(const std::filesystem::path& checkpoint) {
  const auto state = nlohmann::json::parse(file_text(checkpoint), nullptr, false);
  return !state.is_discarded() && state.contains("stop_reason") && state["stop_reason"] != "";
}

class Resume : public ::testing::Test {
 protected:
  Resume() { write_text(folder_ / "tiny.yaml", kTinyRun); }

  ProgramResult run(Words words) const {
    words.push_back("--quiet");
    return evenglow(words, folder_.path());
  }

  /// Starts the program and sends the signal as soon as `moment` has come.
  ProgramResult interrupted(const Words& words, int signal, const std::function<bool()>& moment) const {
    Program program(words_of(EVENGLOW_PROGRAM, words), folder_.path());
    while (program.is_running() && !moment()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    program.send(signal);
    return program.wait(60);
  }

  /// Interrupts a design in its step 2, with the larger part of its time to come.
  ProgramResult interrupted_design(int signal) const {
    return interrupted(design("out"), signal, [&] { return has_steps(checkpoint_, 2); });
  }

  static Words design(const std::string& out) {
    return {"design",    "tiny.yaml",
            "-o",        out,
            "--threads", "2",
            "--photons", "1e5",
            "--set",     "design.max_steps=4",
            "--set",     "design.first_photons=3e4"};
  }

  static Words with(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
  }

  TempFolder folder_;
  std::filesystem::path checkpoint_ = folder_ / "out" / "checkpoint.json";
};

class ResumeAfterSignal : public Resume, public ::testing::WithParamInterface<int> {};

TEST_P(ResumeAfterSignal, ADesignEndsInTheSameBits) {
  ASSERT_EQ(run(design("whole")).code, 0);
  const ProgramResult stopped = interrupted_design(GetParam());
  EXPECT_EQ(stopped.code, GetParam() == SIGKILL ? 128 + SIGKILL : 130) << stopped.err;
  EXPECT_EQ(stopped.out, "");
  const char* const told = GetParam() == SIGKILL ? "" : "interrupted: --resume goes on";
  EXPECT_THAT(stopped.err, HasSubstr(told));
  ASSERT_TRUE(has_steps(checkpoint_, 2));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "result.json"));

  const ProgramResult plain = run(design("out"));
  EXPECT_EQ(plain.code, 2);
  EXPECT_THAT(plain.err, StartsWith("out: must not hold another run, got checkpoint.json in it (--resume goes on"));

  const ProgramResult resumed = evenglow(with(design("out"), {"--resume"}), folder_.path());
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, StartsWith("resumed after step "));
  EXPECT_THAT(resumed.err, ::testing::Not(HasSubstr("step 0: "))) << "no step is made twice";
  EXPECT_EQ(lasting_part(folder_ / "out" / "result.json"), lasting_part(folder_ / "whole" / "result.json"));
  for (const char* name : {"density.csv", "luminance.csv", "luminance_se.csv"}) {
    EXPECT_EQ(file_text(folder_ / "out" / name), file_text(folder_ / "whole" / name)) << name;
  }
  EXPECT_FALSE(std::filesystem::exists(checkpoint_)) << "a finished run leaves no checkpoint";
  EXPECT_FALSE(std::filesystem::exists(checkpoint_.string() + ".new"));
}

INSTANTIATE_TEST_SUITE_P(Signals, ResumeAfterSignal, ::testing::Values(SIGINT, SIGTERM, SIGKILL),
                         [](const ::testing::TestParamInfo<int>& signal) {
                           return signal.param == SIGINT ? "Int" : signal.param == SIGTERM ? "Term" : "Kill";
                         });

TEST_F(Resume, OfTheFinalTraceRepeatsOnlyThat) {
  const Words words = {"design", "tiny.yaml", "-o", "out", "--photons", "5e5", "--set", "design.max_steps=0"};
  Words whole = words;
  whole[3] = "whole";
  ASSERT_EQ(run(whole).code, 0);
  const ProgramResult stopped = interrupted(words, SIGINT, [&] { return has_ended(checkpoint_); });
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  const ProgramResult resumed = evenglow(with(words, {"--resume"}), folder_.path());
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, ::testing::Not(HasSubstr("photons, RMS"))) << "no design step is made again";
  EXPECT_EQ(lasting_part(folder_ / "out" / "result.json"), lasting_part(folder_ / "whole" / "result.json"));
}

TEST_F(Resume, OfAComparisonKeepsTheVariantsThatAreDesigned) {
  const auto compare = [](const std::string& out) {
    return Words{"compare", "tiny.yaml", "-o", out, "--photons", "1e5", "--threads", "2"};
  };
  ASSERT_EQ(run(compare("whole")).code, 0);
  const auto second = folder_ / "out" / "dbef" / "checkpoint.json";
  const ProgramResult stopped = interrupted(compare("out"), SIGINT, [&] { return has_steps(second, 3); });
  EXPECT_EQ(stopped.code, 130) << stopped.err;
  ASSERT_TRUE(std::filesystem::exists(folder_ / "out" / "lpp" / "result.json"));
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "compare.json"));

  const ProgramResult resumed = evenglow(with(compare("out"), {"--resume"}), folder_.path());
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("lpp: resumed after step 3"));
  EXPECT_THAT(resumed.err, HasSubstr("dbef: resumed after step "));
  EXPECT_THAT(resumed.err, ::testing::Not(HasSubstr("lpp: step "))) << "no design step of the first is made again";
  EXPECT_EQ(file_text(folder_ / "out" / "compare.json"), file_text(folder_ / "whole" / "compare.json"));
  for (const std::string name : {"lpp", "dbef"}) {
    EXPECT_EQ(lasting_part(folder_ / "out" / name / "result.json"),
              lasting_part(folder_ / "whole" / name / "result.json"));
    EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / name / "checkpoint.json"));
  }
}

TEST_F(Resume, OfASimulationIsNotOffered) {
  const ProgramResult stopped = interrupted({"simulate", "tiny.yaml", "-o", "out", "--photons", "5e7"}, SIGINT,
                                            [&] { return std::filesystem::exists(folder_ / "out"); });
  EXPECT_EQ(stopped.code, 130);
  EXPECT_THAT(stopped.err, HasSubstr("interrupted: nothing was written"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

TEST_F(Resume, WithNothingToResumeBeginsAnew) {
  EXPECT_EQ(run({"design", "tiny.yaml", "-o", "out", "--resume"}).code, 0);
  const ProgramResult again = run({"design", "tiny.yaml", "-o", "out", "--resume"});
  EXPECT_EQ(again.code, 2) << "a finished result is not made anew unasked";
  EXPECT_THAT(again.err, StartsWith("out: there is nothing to resume"));
}

TEST_F(Resume, OfAnotherRunIsRefused) {
  write_text(folder_ / "table.csv",
             file_text(std::filesystem::path(EVENGLOW_SOURCE_DIR) / "tests/app/faulty/tables/good.csv"));
  const Words words = with(design("out"), {"--set", "backlight.films[1]={kind: dbef, table: table.csv}"});
  ASSERT_EQ(interrupted(words, SIGINT, [&] { return has_steps(checkpoint_, 1); }).code, 130);
  const std::string state = file_text(checkpoint_);
  const auto expect_refusal = [&](const Words& changed) {
    const ProgramResult result = run(with(changed, {"--resume"}));
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err_lines().size(), 1u);
    EXPECT_THAT(result.err, HasSubstr("out/checkpoint.json: the checkpoint is of another run"));
    EXPECT_THAT(result.err, HasSubstr("--overwrite begins anew"));
    EXPECT_EQ(file_text(checkpoint_), state) << "a refusal changes nothing";
  };
  expect_refusal(with(words, {"--seed", "8"}));
  write_text(folder_ / "tiny.yaml", std::string(kTinyRun) + "# changed\n");
  expect_refusal(words);
  write_text(folder_ / "tiny.yaml", kTinyRun);
  const std::string table = file_text(folder_ / "table.csv");
  write_text(folder_ / "table.csv", table + "# changed\n");
  expect_refusal(words);
  write_text(folder_ / "table.csv", table);
  Words one_thread = words;
  *(std::find(one_thread.begin(), one_thread.end(), "--threads") + 1) = "1";
  EXPECT_EQ(run(with(one_thread, {"--resume"})).code, 0) << "threads change nothing";
}

TEST_F(Resume, OfAnotherCommandIsRefused) {
  ASSERT_EQ(interrupted_design(SIGINT).code, 130);
  const std::string state = file_text(checkpoint_);
  for (const char* command : {"pareto", "optimize"}) {
    Words words = with(design("out"), {"--resume"});
    words[0] = command;
    if (words[0] == "optimize")
      words = with(words, {"--set", "optimize=[{key: backlight.light_guide_plate.thickness_mm, range: [0.5, 0.7]}]"});
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 2) << command;
    EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr("out/checkpoint.json: the checkpoint "));
    EXPECT_EQ(file_text(checkpoint_), state);
  }
}

/// Another build: the same program, but for the checksum that the linker has left in it.
TEST_F(Resume, OfAnotherBuildIsRefused) {
  ASSERT_EQ(interrupted_design(SIGINT).code, 130);
  std::string program = file_text(EVENGLOW_PROGRAM);
  const std::size_t note = program.find(std::string("\x14\0\0\0\x03\0\0\0GNU\0", 12));
  ASSERT_NE(note, std::string::npos);
  for (std::size_t i = note + 12; i < note + 32; ++i) program[i] = static_cast<char>(~program[i]);
  write_text(folder_ / "other", program);
  std::filesystem::permissions(folder_ / "other", std::filesystem::perms::owner_all);
  const ProgramResult result =
      run_program(words_of((folder_ / "other").string(), with(design("out"), {"--resume", "--quiet"})), folder_.path());
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, HasSubstr("the checkpoint is of another run (another command or program"));
  ASSERT_EQ(run(with(design("out"), {"--resume"})).code, 0);
  const auto id = json_of(folder_ / "out" / "result.json")["program_build_id"].get<std::string>();
  EXPECT_EQ(id.size(), 40u);
}

TEST_F(Resume, OfADamagedCheckpointIsRefused) {
  ASSERT_EQ(interrupted_design(SIGINT).code, 130);
  const std::string state = file_text(checkpoint_);
  const auto previous = folder_ / "out" / "checkpoint.previous.json";
  ASSERT_TRUE(std::filesystem::exists(previous));
  std::string other_version = state;
  const std::size_t at = other_version.find("evenglow-checkpoint/");
  ASSERT_NE(at, std::string::npos);
  other_version.replace(at, 20, "evenglow-checkpoint?");
  for (const std::string& damaged :
       {std::string(), std::string("{}"), std::string("[1, 2]"), std::string("no JSON\n\x1b"),
        state.substr(0, state.size() / 2), state + state, other_version}) {
    write_text(checkpoint_, damaged);
    write_text(previous, damaged);
    const ProgramResult result = run(with(design("out"), {"--resume"}));
    EXPECT_EQ(result.code, 2) << damaged.substr(0, 40);
    EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
    EXPECT_THAT(result.err, HasSubstr("out/checkpoint.json: the checkpoint cannot be used"));
    EXPECT_EQ(file_text(checkpoint_), damaged);
  }
  ASSERT_EQ(run(with(design("out"), {"--overwrite"})).code, 0);
  EXPECT_FALSE(std::filesystem::exists(checkpoint_));
}

TEST_F(Resume, ASecondSignalEndsTheProgramAtOnce) {
  Program program(words_of(EVENGLOW_PROGRAM, {"design", "tiny.yaml", "-o", "out", "--photons", "1e9", "--set",
                                              "design.first_photons=1e9"}),
                  folder_.path());
  while (program.is_running() && !std::filesystem::exists(folder_ / "out")) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  program.send(SIGINT);
  std::this_thread::sleep_for(std::chrono::milliseconds(20));
  program.send(SIGINT);
  const ProgramResult result = program.wait(10);
  EXPECT_FALSE(result.timed_out);
  EXPECT_EQ(result.code, 130);
}

}  // namespace
}  // namespace evenglow::tests
