#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <set>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// The program under `mpirun`: one result on any number of ranks, whatever happens to them. Built with MPI alone, label
/// `mpi`.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

using Words = std::vector<std::string>;
namespace fs = std::filesystem;

Words mpirun(int ranks, const Words& arguments) {
  Words words = {"/usr/bin/env", "mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to",
                 "none",         "-n",     std::to_string(ranks), EVENGLOW_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  return words;
}

const std::set<std::string> kTablesOfCost = {"convergence.csv", "pareto.csv", "optimize.csv", "batch.csv"};

/// What runs cost is told of the machine, at any depth of a table.
nlohmann::ordered_json without_cost(nlohmann::ordered_json json) {
  if (json.is_object()) {
    for (const char* key : {"timing", "cpu_s", "sha256"}) json.erase(key);  // the seal of batch.json holds the costs
  }
  for (auto& part : json) {
    if (part.is_structured()) part = without_cost(part);
  }
  return json;
}

/// All files of a result, the numbers that tell of the machine taken out.
std::string bits_of(const fs::path& directory) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(directory)) {
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), directory));
  }
  std::sort(files.begin(), files.end());
  std::string bits;
  for (const fs::path& file : files) {
    bits += file.string() + "\n";
    if (file.filename() == "result.json") {
      bits += lasting_part(directory / file);
    } else if (file.extension() == ".json") {
      bits += without_cost(json_of(directory / file)).dump();
    } else if (file.extension() == ".csv" || file.filename() == "luminance.png" || file.filename() == "density.png") {
      // What runs cost stands in these tables, and the same numbers in their JSON.
      if (!kTablesOfCost.contains(file.filename().string())) bits += file_text(directory / file);
    }
  }
  return bits;
}

/// The processes of the program below a process.
std::vector<int> ranks_below(int parent) {
  std::vector<int> pids;
  for (const auto& entry : fs::directory_iterator("/proc")) {
    const std::string status = file_text(entry.path() / "stat");
    const std::size_t name_end = status.rfind(')');
    if (name_end == std::string::npos || status.find("(evenglow)") == std::string::npos) continue;
    if (std::stoi(status.substr(name_end + 4)) == parent) pids.push_back(std::stoi(entry.path().filename()));
  }
  std::sort(pids.begin(), pids.end());
  return pids;
}

class Mpi : public ::testing::Test {
 protected:
  Mpi() {
    const std::string tiny = kTinyRun;
    write_text(folder_ / "tiny.yaml", tiny);
    std::string alone = tiny;
    alone.erase(alone.find("variants:"), alone.find("trace:") - alone.find("variants:"));
    write_text(folder_ / "sweep.yaml", alone + "sweep: {grid: {trace.seed: [1, 2, 3]}}\n");
    write_text(folder_ / "outer.yaml", alone +
                                           "optimize:\n  - {key: design.level, range: [0.05, 0.3]}\n"
                                           "  - {key: \"backlight.films[0].haze\", range: [0.5, 0.95]}\n"
                                           "optimizer: {evaluations: 4, rms: 0.2}\n");
  }

  ProgramResult run(int ranks, const Words& arguments) const {
    return ranks == 0 ? evenglow(arguments, folder_.path()) : run_program(mpirun(ranks, arguments), folder_.path());
  }

  static Words design(const std::string& out, const Words& more = {}) {
    return design_words(out, {"--photons", "1e5", "--set", "design.max_steps=4", "--set", "design.first_photons=3e4"},
                        more);
  }

  /// Starts a command on ranks and sends the signal to one of them (-1: to mpirun) when it has come far enough.
  ProgramResult struck(int ranks, int rank, int signal, const Words& arguments,
                       const std::function<bool()>& far) const {
    const std::string command = "echo $$ > pid; exec \"$@\"";
    Words words = {"/bin/sh", "-c", command, "sh"};
    const Words launched = mpirun(ranks, arguments);
    words.insert(words.end(), launched.begin(), launched.end());
    Program program(words, folder_.path());
    while (program.is_running() && !far()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    const int launcher = std::stoi(file_text(folder_ / "pid"));
    if (rank < 0) {
      ::kill(launcher, signal);
    } else {
      const auto pids = ranks_below(launcher);
      EXPECT_EQ(pids.size(), static_cast<std::size_t>(ranks));
      if (pids.size() > static_cast<std::size_t>(rank)) ::kill(pids[static_cast<std::size_t>(rank)], signal);
    }
    return program.wait(60);
  }

  TempFolder folder_;
};

/// Ranks in two folders, with run files of one name and another content.
TEST_F(Mpi, RanksWithOtherInputAreRefused) {
  for (const char* name : {"a", "b"}) {
    fs::create_directory(folder_ / name);
    write_text(folder_ / name / "r.yaml", std::string(kTinyRun) + (name[0] == 'b' ? "# another\n" : ""));
  }
  for (const std::string command : {"simulate", "design", "pareto", "compare", "batch"}) {
    Words words = mpirun(1, {command, "r.yaml", "-o", "out", "--quiet"});
    const auto count = std::find(words.begin(), words.end(), "-n");
    ASSERT_NE(count, words.end());
    const Words part(count, words.end());
    words.insert(count, {"--wdir", (folder_ / "a").string()});
    words.push_back(":");
    words.insert(words.end(), {"--wdir", (folder_ / "b").string()});
    words.insert(words.end(), part.begin(), part.end());
    const ProgramResult result = run_program(words, folder_.path());
    EXPECT_EQ(result.code, 2) << command << result.err;
    EXPECT_THAT(result.err, HasSubstr("rank 1: must be given the input of rank 0")) << command;
    EXPECT_FALSE(fs::exists(folder_ / "a" / "out")) << command;
  }
}

TEST_F(Mpi, EveryCommandHasTheSameBitsOnAnyNumberOfRanksAndThreads) {
  const std::vector<std::pair<std::string, Words>> commands = {
      {"design", {"design", "tiny.yaml"}},
      {"simulate", {"simulate", "tiny.yaml"}},
      {"compare", {"compare", "tiny.yaml"}},
      {"pareto", {"pareto", "tiny.yaml", "--set", "design.pareto_levels=[0.2,0.4]"}},
      {"optimize", {"optimize", "outer.yaml"}},
      {"batch", {"batch", "sweep.yaml"}},
      {"reuse", {"design", "tiny.yaml", "--set", "design.updater=path_reuse"}}};
  for (const auto& [name, command] : commands) {
    const auto outcome = [&](int ranks, const std::string& threads) {
      const std::string out = name + std::to_string(ranks) + "x" + threads;
      Words words = command;
      for (const std::string& word :
           {std::string("-o"), out, std::string("--threads"), threads, std::string("--quiet")})
        words.push_back(word);
      const ProgramResult result = run(ranks, words);
      EXPECT_EQ(result.code, 0) << result.err;
      EXPECT_FALSE(fs::exists(folder_ / out / ".evenglow-lock"));
      return bits_of(folder_ / out);
    };
    const std::string alone = outcome(0, "1");
    EXPECT_FALSE(alone.empty());
    for (const char* threads : {"2", "4"}) EXPECT_TRUE(outcome(0, threads) == alone) << name << threads;
    for (const int ranks : {1, 2, 3, 4}) EXPECT_TRUE(outcome(ranks, "1") == alone) << name << ranks;
    EXPECT_TRUE(outcome(2, "2") == alone) << name;
  }
}

TEST_F(Mpi, RankZeroAloneTells) {
  const ProgramResult one = run(0, {"simulate", "tiny.yaml", "-o", "one"});
  const ProgramResult three = run(3, {"simulate", "tiny.yaml", "-o", "three"});
  EXPECT_EQ(json_of(folder_ / "three" / "result.json").at("ranks"), 3);
  EXPECT_EQ(std::count(one.out.begin(), one.out.end(), '\n'), std::count(three.out.begin(), three.out.end(), '\n'));
  const ProgramResult wrong = run(3, {"simulate", "tiny.yaml", "-o", "none", "--set", "trace.photons=-1"});
  EXPECT_EQ(wrong.code, 2);
  const std::string told = "trace.photons";
  EXPECT_NE(wrong.err.find(told), std::string::npos) << wrong.err;
  EXPECT_EQ(wrong.err.find(told, wrong.err.find(told) + 1), std::string::npos) << "told once: " << wrong.err;
}

TEST_F(Mpi, ACommandThatIsNotSharedIsDoneByRankZero) {
  const ProgramResult result = run(3, {"check", "tiny.yaml"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(std::count(result.out.begin(), result.out.end(), '\n'), 2) << result.out;
}

TEST_F(Mpi, ADirectoryInUseOrFullIsRefusedOnce) {
  ASSERT_EQ(run(2, design("out")).code, 0);
  const ProgramResult again = run(3, design("out"));
  EXPECT_EQ(again.code, 2);
  EXPECT_THAT(again.err, HasSubstr("must not hold another result"));
}

/// A search over scalar keys and a batch whose rank 1 dies between two designs, on 3 ranks and then on others.
TEST_F(Mpi, ASearchAndABatchGoOnAfterADeadRank) {
  struct Long {
    const char* name;
    Words command;
    std::string sign;  ///< a file that is there when something is done and something left
  };
  const std::vector<Long> commands = {
      {"optimize", {"optimize", "outer.yaml", "--photons", "2e5", "--threads", "1"}, "out/checkpoint.json"},
      {"batch", {"batch", "sweep.yaml", "--photons", "2e5", "--threads", "1"}, "out/p1_seed-1/result.json"}};
  for (const auto& [name, command, sign] : commands) {
    const auto into = [&](const std::string& out, bool resume) {
      Words words = command;
      for (const std::string& word : {std::string("-o"), out, std::string("--quiet")}) words.push_back(word);
      if (resume) words.push_back("--resume");
      return words;
    };
    ASSERT_EQ(run(0, into(std::string("whole_") + name, false)).code, 0);
    const std::string expected = bits_of(folder_ / (std::string("whole_") + name));
    EXPECT_FALSE(expected.empty());
    for (const int ranks : {0, 2, 4}) {
      fs::remove_all(folder_ / "out");
      const ProgramResult result =
          struck(3, 1, SIGKILL, into("out", false), [&, file = folder_ / sign] { return fs::exists(file); });
      EXPECT_NE(result.code, 0) << name;
      EXPECT_FALSE(result.timed_out) << name;
      const ProgramResult resumed = run(ranks, into("out", true));
      ASSERT_EQ(resumed.code, 0) << name << resumed.err;
      EXPECT_TRUE(bits_of(folder_ / "out") == expected) << name << ranks;
    }
  }
}

struct Blow {
  int rank;
  int signal;
  const char* updater;
};

class MpiBlow : public Mpi, public ::testing::WithParamInterface<Blow> {};

/// A rank that dies, the first among them, and an end by mpirun itself.
TEST_P(MpiBlow, ARunGoesOnOnAnyNumberOfRanks) {
  // So many steps that the blow comes before their end, however long mpirun takes to pass it on.
  const Words more = {
      "--set", std::string("design.updater=") + GetParam().updater, "--set", "design.max_steps=12", "--threads", "1"};
  ASSERT_EQ(run(0, design("whole", more)).code, 0);
  const std::string expected = bits_of(folder_ / "whole");
  Words resume = more;
  resume.push_back("--resume");
  for (const int ranks : {0, 1, 2, 3, 4}) {
    fs::remove_all(folder_ / "out");
    const ProgramResult result = struck(3, GetParam().rank, GetParam().signal, design("out", more),
                                        [&] { return saved_steps(folder_ / "out") >= 2; });
    EXPECT_NE(result.code, 0) << result.err;
    EXPECT_FALSE(result.timed_out);
    EXPECT_FALSE(result.err.empty());
    EXPECT_GE(saved_steps(folder_ / "out"), 1u) << result.err;
    const ProgramResult resumed = run(ranks, design("out", resume));
    ASSERT_EQ(resumed.code, 0) << resumed.err;
    EXPECT_TRUE(bits_of(folder_ / "out") == expected) << ranks;
  }
}

INSTANTIATE_TEST_SUITE_P(Moments, MpiBlow,
                         ::testing::Values(Blow{1, SIGKILL, "auto"}, Blow{0, SIGKILL, "ratio_noise_aware"},
                                           Blow{2, SIGKILL, "path_reuse"}, Blow{-1, SIGTERM, "auto"},
                                           Blow{-1, SIGINT, "auto"}, Blow{1, SIGTERM, "auto"}));

}  // namespace
}  // namespace evenglow::tests
