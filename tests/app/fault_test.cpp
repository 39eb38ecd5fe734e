#include <chrono>
#include <csignal>
#include <random>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "tests/app/tiny_run.h"

/// What befalls a run from outside: kills at any moment, full disks, folders that go, other runs.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

using Words = std::vector<std::string>;

class Faults : public ::testing::Test {
 protected:
  Faults() { write_text(folder_ / "tiny.yaml", kTinyRun); }

  static Words design(const std::string& out, const Words& more = {}) {
    return design_words(
        out, {"--threads", "1", "--photons", "5e4", "--set", "design.max_steps=6", "--set", "design.first_photons=2e4"},
        more);
  }

  /// Kills designs at random moments of their time, and has each go on: to the bits of one that was let alone.
  void kill_and_resume(int times) {
    const auto start = std::chrono::steady_clock::now();
    ASSERT_EQ(evenglow(design("whole"), folder_.path()).code, 0);
    const auto whole_ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(std::chrono::steady_clock::now() - start);
    const std::string expected = lasting_part(folder_ / "whole" / "result.json");
    std::mt19937 random(1);
    for (int i = 0; i < times; ++i) {
      std::filesystem::remove_all(folder_ / "out");
      Program program(words_of(EVENGLOW_PROGRAM, design("out")), folder_.path());
      std::this_thread::sleep_for(whole_ms * static_cast<int>(random() % 1000) / 1000);
      program.send(SIGKILL);
      const ProgramResult killed = program.wait(60);
      if (killed.code == 0) continue;  // it was faster this time
      if (!std::filesystem::exists(folder_ / "out" / "checkpoint.json") &&
          std::filesystem::exists(folder_ / "out" / "result.json")) {  // killed when all was done
        EXPECT_EQ(lasting_part(folder_ / "out" / "result.json"), expected);
        continue;
      }
      std::size_t told = 0;
      for (const std::string& line : killed.err_lines()) told += line.starts_with("step ") ? 1 : 0;
      EXPECT_GE(saved_steps(folder_ / "out") + 1, told) << "more than a step was lost";
      const ProgramResult resumed = evenglow(design("out", {"--resume"}), folder_.path());
      ASSERT_EQ(resumed.code, 0) << resumed.err;
      EXPECT_EQ(lasting_part(folder_ / "out" / "result.json"), expected);
      for (const char* left : {"checkpoint.json", "checkpoint.previous.json", ".evenglow-lock"})
        EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / left)) << left;
    }
  }

  /// A design that has made a step or more and has long to go.
  std::unique_ptr<Program> long_design() const {
    const std::string command = "echo $$ > pid; exec '" + std::string(EVENGLOW_PROGRAM) +
                                "' design tiny.yaml -o out --photons 2e6 --threads 1 --set design.max_steps=40 --set "
                                "design.stop_rms=0.0001 --set design.first_photons=2e4";
    auto program = std::make_unique<Program>(Words{"/bin/sh", "-c", command}, folder_.path());
    while (program->is_running() && !std::filesystem::exists(folder_ / "out" / "checkpoint.previous.json"))
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return program;
  }

  TempFolder folder_;
};

TEST_F(Faults, AKillAtAnyMomentLosesAStepAtMost) {
  kill_and_resume(3);
}

class FaultsLong : public Faults {};

TEST_F(FaultsLong, AKillAtAnyOfManyMomentsLosesAStepAtMost) {
  kill_and_resume(20);
}

TEST_F(Faults, ASecondRunInTheSameDirectoryIsRefused) {
  const auto first = long_design();
  for (const char* option : {"--overwrite", "--resume", "--quiet"}) {
    const ProgramResult second = evenglow(design("out", {option}), folder_.path());
    EXPECT_EQ(second.code, 2);
    EXPECT_EQ(second.err_lines().size(), 1u) << second.err;
    EXPECT_THAT(second.err,
                HasSubstr("out: must not be in use by another run, got one that is at work in it (process "));
  }
  EXPECT_EQ(evenglow({"simulate", "tiny.yaml", "-o", "out", "--overwrite"}, folder_.path()).code, 2);
  EXPECT_EQ(evenglow({"batch", "tiny.yaml", "-o", "out", "--overwrite"}, folder_.path()).code, 2);
  first->send(SIGKILL);
  EXPECT_EQ(first->wait(60).code, 128 + SIGKILL);
  ASSERT_TRUE(std::filesystem::exists(folder_ / "out" / ".evenglow-lock"));
  EXPECT_EQ(evenglow(design("out", {"--overwrite", "--quiet"}), folder_.path()).code, 0) << "a dead run locks nothing";
}

TEST_F(Faults, ADiskThatFillsIsToldWhenItDoesAndTheStateStays) {
  const auto program = long_design();
  const pid_t pid = std::stoi(file_text(folder_ / "pid"));
  const rlimit limit{64, RLIM_INFINITY};
  ASSERT_EQ(::prlimit(pid, RLIMIT_FSIZE, &limit, nullptr), 0);
  const ProgramResult stopped = program->wait(60);
  EXPECT_EQ(stopped.code, 1);
  EXPECT_NE(saved_steps(folder_ / "out"), 0u);
  EXPECT_FALSE(std::filesystem::exists(folder_ / "out" / "checkpoint.json.part"));
}

TEST_F(Faults, AFullDiskIsToldBeforeAPhotonIsTraced) {
  const ProgramResult result =
      run_program({"/bin/sh", "-c",
                   "ulimit -f 8; exec '" + std::string(EVENGLOW_PROGRAM) + "' design tiny.yaml -o out --photons 1e11"},
                  folder_.path(), 60);
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "evenglow: cannot write to out: File too large\n");
}

/// Fine cells need more than the rest: 16 MiB do not hold the states and results of 45,000.
TEST_F(Faults, ADiskTooSmallForTheCellsIsToldBeforeAPhotonIsTraced) {
  const auto with_cells = [&](const std::string& cells, const std::string& photons) {
    return run_program({"/bin/sh", "-c",
                        "ulimit -f 32768; exec '" + std::string(EVENGLOW_PROGRAM) +
                            "' design tiny.yaml -o out --quiet --overwrite --photons " + photons +
                            " --set 'backlight.microstructure.cells=" + cells + "'"},
                       folder_.path(), 60);
  };
  const ProgramResult fine = with_cells("[300, 150]", "1e11");
  EXPECT_EQ(fine.code, 1);
  EXPECT_EQ(fine.err, "evenglow: cannot write to out: File too large\n");
  EXPECT_EQ(with_cells("[8, 4]", "2e4").code, 0);
}

TEST_F(Faults, APhotonOfTheStepThatWasAtWorkCanBeFollowed) {
  const auto program = long_design();
  program->send(SIGKILL);
  program->wait(60);
  const auto trace = [&](const Words& more) {
    Words words = {"trace", "tiny.yaml", "--photon", "5", "--step", "2"};
    words.insert(words.end(), more.begin(), more.end());
    return evenglow(words, folder_.path());
  };
  const ProgramResult followed = trace({"--state", "out/checkpoint.json"});
  EXPECT_EQ(followed.code, 0) << followed.err;
  EXPECT_THAT(followed.out, HasSubstr("photon 5 of step 2"));
  const ProgramResult nothing = trace({"--state", "nowhere.json"});
  EXPECT_EQ(nothing.code, 2);
  EXPECT_THAT(nothing.err, HasSubstr("--state: must be a checkpoint.json, found none at"));
  EXPECT_EQ(trace({"--state", "out/checkpoint.json", "--set", "backlight.microstructure.cells=[3, 3]"}).code, 2);
}

TEST_F(Faults, ADirectoryThatIsRemovedIsTold) {
  const auto program = long_design();
  std::filesystem::rename(folder_ / "out", folder_ / "gone");
  const ProgramResult stopped = program->wait(60);
  EXPECT_EQ(stopped.code, 1);
  EXPECT_THAT(stopped.err, HasSubstr("evenglow: cannot write to out: its .evenglow-lock has gone"));
}

/// Another run has the name by now: the first must not write among its files.
TEST_F(Faults, ADirectoryThatIsTakenOverIsLeftAlone) {
  const auto program = long_design();
  std::filesystem::rename(folder_ / "out", folder_ / "gone");
  std::filesystem::create_directory(folder_ / "out");
  const ProgramResult stopped = program->wait(60);
  EXPECT_EQ(stopped.code, 1);
  EXPECT_THAT(stopped.err,
              HasSubstr("evenglow: cannot write to out: its .evenglow-lock has gone or is of another run"));
  EXPECT_TRUE(std::filesystem::is_empty(folder_ / "out"));
}

TEST_F(Faults, OfADamagedCheckpointTheOneBeforeIsUsed) {
  const Words words = {"design", "tiny.yaml", "-o", "out", "--photons", "5e4", "--set", "design.max_steps=6"};
  Words whole = words;
  whole[3] = "whole";
  ASSERT_EQ(evenglow(whole, folder_.path()).code, 0);
  Program program(words_of(EVENGLOW_PROGRAM, words), folder_.path());
  while (program.is_running() && saved_steps(folder_ / "out") < 3)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  program.send(SIGKILL);
  program.wait(60);
  const auto checkpoint = folder_ / "out" / "checkpoint.json";
  std::string state = file_text(checkpoint);
  ASSERT_GT(state.size(), 500u);
  state[state.size() / 2] ^= 1;
  write_text(checkpoint, state);
  Words resume = words;
  resume.push_back("--resume");
  const ProgramResult resumed = evenglow(resume, folder_.path());
  ASSERT_EQ(resumed.code, 0) << resumed.err;
  EXPECT_THAT(resumed.err, HasSubstr("out/checkpoint.json: the checkpoint cannot be used (its checksum is wrong: cut "
                                     "short or altered); the one of the step before is used"));
  EXPECT_EQ(lasting_part(folder_ / "out" / "result.json"), lasting_part(folder_ / "whole" / "result.json"));
}

}  // namespace
}  // namespace evenglow::tests
