#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/app/tiny_run.h"

/// The words after `evenglow`: what is explained, what is refused, and that a refusal changes nothing.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

using Words = std::vector<std::string>;

class CommandLine : public ::testing::Test {
 protected:
  CommandLine() { write_text(folder_ / "tiny.yaml", kTinyRun); }

  ProgramResult run(const Words& words) const { return evenglow(words, folder_.path()); }

  /// One line on stderr, exit code 2, nothing on stdout, nothing new in the folder.
  std::string refused(const Words& words) const {
    const std::size_t before = count();
    const ProgramResult result = run(words);
    EXPECT_EQ(result.code, 2) << result.err;
    EXPECT_THAT(result.out, IsEmpty());
    EXPECT_EQ(result.err_lines().size(), 1u) << result.err;
    EXPECT_EQ(count(), before);
    return result.err;
  }

  std::size_t count() const {
    const std::filesystem::recursive_directory_iterator all(folder_.path());
    return static_cast<std::size_t>(std::distance(begin(all), end(all)));
  }

  TempFolder folder_;
};

// ---------------------------------------------------------------- help

TEST_F(CommandLine, HelpNamesTheCommandsAndTheExitCodes) {
  const ProgramResult result = run({"--help"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.err, IsEmpty());
  for (const char* word : {"check", "simulate", "design", "compare", "film", "130 interrupted", "Usage: evenglow "}) {
    EXPECT_THAT(result.out, HasSubstr(word));
  }
}

TEST_F(CommandLine, EachCommandIsExplainedWithAnExampleThatIsThere) {
  for (const std::string command : {"check", "simulate", "design", "compare"}) {
    const ProgramResult result = run({command, "--help"});
    EXPECT_EQ(result.code, 0);
    EXPECT_THAT(result.err, IsEmpty());
    const std::size_t example = result.out.find("Example: evenglow " + command + " configs/");
    ASSERT_NE(example, std::string::npos) << result.out;
    const std::size_t begin = result.out.find("configs/", example);
    const std::string file = result.out.substr(begin, result.out.find_first_of(" \n", begin) - begin);
    EXPECT_TRUE(std::filesystem::exists(std::filesystem::path(EVENGLOW_SOURCE_DIR) / file)) << file;
    EXPECT_THAT(result.out, HasSubstr("--set KEY=VALUE"));
    EXPECT_EQ(result.out.find("--resume") != std::string::npos, command == "design" || command == "compare");
    EXPECT_EQ(result.out.find("--overwrite") != std::string::npos, command != "check");
  }
}

TEST_F(CommandLine, VersionIsOneLine) {
  const ProgramResult result = run({"--version"});
  EXPECT_EQ(result.code, 0);
  EXPECT_THAT(result.out, ::testing::MatchesRegex("evenglow [0-9.]+\n"));
}

// ---------------------------------------------------------------- wrong words

TEST_F(CommandLine, WordsThatAreNoCommandAreRefused) {
  EXPECT_THAT(refused({}), HasSubstr("a command is required (evenglow --help tells more)"));
  EXPECT_THAT(refused({"frob"}), HasSubstr("the command must be one of check, simulate, design, compare"));
  EXPECT_THAT(refused({"desing", "tiny.yaml"}), HasSubstr("got desing, did you mean design?"));
  EXPECT_THAT(refused({"a\nb"}), HasSubstr("got a\\nb"));
}

TEST_F(CommandLine, WrongOptionsAreRefused) {
  EXPECT_THAT(refused({"design"}), HasSubstr("RUN.yaml is required (evenglow design --help tells more)"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "--frob"}), HasSubstr("--frob"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "other.yaml"}), HasSubstr("RUN.yaml: At Most 1 required but received 2"));
  EXPECT_THAT(refused({"simulate", "tiny.yaml", "--resume"}), HasSubstr("--resume"));
  EXPECT_THAT(refused({"check", "tiny.yaml", "-o", "out"}), HasSubstr("-o"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "-o"}), HasSubstr("--out"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "--threads", "-1"}), HasSubstr("--threads: Value -1 not in range"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "--threads", "two"}), HasSubstr("--threads: Value two not in range"));
  EXPECT_THAT(refused({"design", "tiny.yaml", "--seed", "1", "--seed", "2"}), HasSubstr("--seed"));
  EXPECT_THAT(refused({"compare", "none.yaml", "--quiet"}), StartsWith("none.yaml: cannot be opened"));
}

struct OptionCase {
  const char* name;
  Words words;
  const char* fault;
};

class FaultyOption : public CommandLine, public ::testing::WithParamInterface<OptionCase> {};

TEST_P(FaultyOption, IsRefusedByItsName) {
  for (const std::string command : {"simulate", "design", "compare"}) {
    Words words = {command, "tiny.yaml", "-o", "out"};
    words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
    EXPECT_THAT(refused(words), StartsWith(GetParam().fault));
  }
  Words words = {"check", "tiny.yaml"};
  words.insert(words.end(), GetParam().words.begin(), GetParam().words.end());
  EXPECT_THAT(refused(words), StartsWith(GetParam().fault));
}

INSTANTIATE_TEST_SUITE_P(
    Corpus, FaultyOption,
    ::testing::Values(
        OptionCase{"SeedNegative", {"--seed", "-1"}, "--seed: trace.seed: must be at least 0, got -1"},
        OptionCase{"SeedText", {"--seed", "abc"}, "--seed: trace.seed: must be a whole number, got abc"},
        OptionCase{"SeedTooLong", {"--seed", "99999999999999999999"}, "--seed: trace.seed: must be a whole number of"},
        OptionCase{"SeedFraction", {"--seed", "1.5"}, "--seed: trace.seed: must be a whole number, got 1.5"},
        OptionCase{"PhotonsZero", {"--photons", "0"}, "--photons: trace.photons: must lie in [1000, "},
        OptionCase{"PhotonsNegative", {"--photons", "-5"}, "--photons: trace.photons: must lie in [1000, "},
        OptionCase{"PhotonsTooMany", {"--photons", "1e30"}, "--photons: trace.photons: must be a whole number of"},
        OptionCase{"PhotonsFraction", {"--photons", "1e4.5"}, "--photons: trace.photons: must be a whole number"},
        OptionCase{"PhotonsWord", {"--photons", "many"}, "--photons: trace.photons: must be a whole number"},
        OptionCase{"PhotonsNothing", {"--photons", ""}, "--photons: "},
        OptionCase{"SetNoValue", {"--set", "trace.photons"}, "--set: must be key=value, got \"trace.photons\""},
        OptionCase{"SetNoKey", {"--set", "=1"}, "--set: must be key=value, got \"=1\""},
        OptionCase{"SetUnknownKey", {"--set", "trace.foton=1"}, "--set: trace.foton: unknown key"},
        OptionCase{"SetBadPath", {"--set", "trace..photons=1"}, "--set: trace..photons: must be a key path such as"},
        OptionCase{
            "SetOutsideStack", {"--set", "backlight.films[7].kind=lpp"}, "--set: backlight.films: holds 2 items"},
        OptionCase{"SetBadYaml", {"--set", "trace.photons=[1, 2"}, "--set: trace.photons: not valid YAML"},
        OptionCase{"SetOutOfRange",
                   {"--set", "backlight.films[1].axis_deg=270"},
                   "--set: backlight.films[1].axis_deg: must lie in [0, 180), got 270"},
        OptionCase{"SetVariants", {"--set", "variants.a={}"}, "--set: variants.a: variants cannot be overridden"},
        OptionCase{"SetSwallowsAnOption", {"--set", "--quiet"}, "--set: must be key=value, got \"--quiet\""},
        OptionCase{"SetDownAScalar", {"--set", "title.a=1"}, "--set: title: must be a map to hold the key `a`"}),
    [](const ::testing::TestParamInfo<OptionCase>& option) { return std::string(option.param.name); });

// ---------------------------------------------------------------- output directory

TEST_F(CommandLine, AFileInPlaceOfTheDirectoryIsRefused) {
  write_text(folder_ / "out", "mine");
  for (const std::string command : {"simulate", "design", "compare"}) {
    EXPECT_EQ(refused({command, "tiny.yaml", "-o", "out"}), "out: must be a directory, got a file\n");
  }
  const ProgramResult below = run({"design", "tiny.yaml", "-o", "out/sub", "--quiet"});
  EXPECT_EQ(below.code, 1);
  EXPECT_EQ(below.err, "evenglow: cannot write to out/sub: Not a directory\n");
  EXPECT_EQ(file_text(folder_ / "out"), "mine");
}

TEST_F(CommandLine, AFileInPlaceOfAVariantsDirectoryIsRefused) {
  std::filesystem::create_directory(folder_ / "out");
  write_text(folder_ / "out" / "dbef", "mine");
  EXPECT_EQ(refused({"compare", "tiny.yaml", "-o", "out"}), "out/dbef: must be a directory, got a file\n");
}

TEST_F(CommandLine, AReadOnlyDirectoryFailsClearly) {
  std::filesystem::create_directory(folder_ / "out");
  std::filesystem::permissions(folder_ / "out",
                               std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  const ProgramResult result = run({"design", "tiny.yaml", "-o", "out", "--quiet"});
  EXPECT_EQ(result.code, 1);
  EXPECT_EQ(result.err, "evenglow: cannot write to out: Permission denied\n");
}

TEST_F(CommandLine, ADirectoryThatNobodyMayWriteToFailsClearly) {
  const ProgramResult result = run({"design", "tiny.yaml", "-o", "/proc/evenglow", "--quiet"});
  EXPECT_EQ(result.code, 1);
  EXPECT_THAT(result.err, StartsWith("evenglow: cannot write to /proc/evenglow: "));
}

TEST_F(CommandLine, AnEarlierResultIsKeptUnlessOverwritten) {
  for (const char* name : {"result.json", "compare.json", "report.html", "luminance.csv", "checkpoint.json"}) {
    std::filesystem::create_directory(folder_ / "out");
    write_text(folder_ / "out" / name, "mine");
    for (const std::string command : {"simulate", "design", "compare"}) {
      const std::string line = refused({command, "tiny.yaml", "-o", "out"});
      EXPECT_THAT(line, StartsWith("out: must not hold another "));
      EXPECT_THAT(line, HasSubstr(name));
      EXPECT_THAT(line, HasSubstr("--overwrite"));
    }
    EXPECT_EQ(file_text(folder_ / "out" / name), "mine");
    std::filesystem::remove_all(folder_ / "out");
  }
}

TEST_F(CommandLine, AnEarlierResultOfAVariantIsKeptToo) {
  std::filesystem::create_directories(folder_ / "out" / "dbef");
  write_text(folder_ / "out" / "dbef" / "result.json", "mine");
  EXPECT_THAT(refused({"compare", "tiny.yaml", "-o", "out"}), StartsWith("out/dbef: must not hold another result"));
}

TEST_F(CommandLine, OverwritingLeavesNothingOfTheEarlierResult) {
  ASSERT_EQ(run({"design", "tiny.yaml", "-o", "out", "--quiet"}).code, 0);
  write_text(folder_ / "out" / "checkpoint.json", "{}");
  write_text(folder_ / "out" / "notes.txt", "mine");
  const ProgramResult again =
      run({"simulate", "tiny.yaml", "-o", "out", "--quiet", "--overwrite", "--set", "output=[json]"});
  EXPECT_EQ(again.code, 0) << again.err;
  EXPECT_THAT(again.err, IsEmpty());
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_ / "out")) {
    names.push_back(entry.path().filename().string());
  }
  EXPECT_THAT(names, ::testing::UnorderedElementsAre("result.json", "notes.txt"));
  EXPECT_EQ(json_of(folder_ / "out" / "result.json").at("stop_reason"), "single trace");
}

TEST_F(CommandLine, WithoutAnOutputDirectoryTheFileNamesIt) {
  EXPECT_EQ(run({"simulate", "tiny.yaml", "--quiet"}).code, 0);
  EXPECT_TRUE(std::filesystem::exists(folder_ / "out" / "tiny" / "result.json"));
}

TEST_F(CommandLine, QuietIsQuietAndProgressGoesToStderr) {
  const ProgramResult loud = run({"design", "tiny.yaml", "-o", "a"});
  const ProgramResult quiet = run({"design", "tiny.yaml", "-o", "b", "--quiet"});
  EXPECT_THAT(quiet.err, IsEmpty());
  EXPECT_THAT(loud.err, HasSubstr("step 0: "));
  EXPECT_THAT(loud.err, ::testing::Not(HasSubstr("\r"))) << "no bar outside a terminal";
  EXPECT_THAT(loud.out, HasSubstr("RMS non-uniformity"));
  EXPECT_THAT(quiet.out, HasSubstr("mean luminance"));
}

}  // namespace
}  // namespace evenglow::tests
