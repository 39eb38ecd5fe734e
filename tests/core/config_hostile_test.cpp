#include <chrono>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include "core/config/config_node.h"
#include "tests/core/config_reading.h"
#include "tests/support/permissions.h"

/// Files that no careful person writes.
namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::string repeated(const std::string& part, std::size_t count) {
  std::string text;
  text.reserve(part.size() * count);
  for (std::size_t i = 0; i < count; ++i) text += part;
  return text;
}

// ---------------------------------------------------------------- structure

struct StructureCase {
  std::string yaml;
  Lines faults;
};

class Structure : public ::testing::TestWithParam<StructureCase> {};

TEST_P(Structure, IsFaultedWithItsPlace) {
  EXPECT_EQ(structure_faults(GetParam().yaml), GetParam().faults);
}

const char* const kMergeFault = "merge keys (<<) are not supported, write the keys out or alias a whole value";

INSTANTIATE_TEST_SUITE_P(
    Corpus, Structure,
    ::testing::Values(
        StructureCase{"a: 1", {}},
        StructureCase{"\xef\xbb\xbf"
                      "a: 1\r\nb: 2\r\n",
                      {}},
        StructureCase{"a: &x {b: 1}\nc: *x\n", {}}, StructureCase{"--- {a: 1}\n...\n", {}}, StructureCase{"{}", {}},
        StructureCase{"", {"run.yaml: must hold a map of keys, got an empty file"}},
        StructureCase{"# only a comment\n", {"run.yaml: must hold a map of keys, got an empty file"}},
        StructureCase{"---\n", {"run.yaml: must hold a map of keys, got an empty file"}},
        StructureCase{"hello world", {"run.yaml:1:1: must hold a map of keys (`key: value`), got hello world"}},
        StructureCase{"- a\n- b\n", {"run.yaml:1:1: must hold a map of keys (`key: value`), got a list"}},
        StructureCase{"a: 1\n---\nb: 2\n", {"run.yaml:2:1: must hold one YAML document, got a second one"}},
        StructureCase{"{a: 1} b", {"run.yaml:1:8: not valid YAML: text after the end"}},
        StructureCase{"a: [1, 2", {"run.yaml:1:4: not valid YAML: end of sequence flow not found"}},
        StructureCase{
            "v: {a.b[2]: 1}",
            {"run.yaml:1:8: not valid YAML: end of map flow not found (within { } a key or text that holds [ ] "
             "{ } or , must be quoted)"}},
        StructureCase{"v:\n  a.b[2]: 1\n  c: {\"a.b[3]\": 1}\n", {}},
        StructureCase{"a: b: c", {"run.yaml:1:5: not valid YAML: illegal map value"}},
        StructureCase{"a: 'x", {"run.yaml:1:6: not valid YAML: illegal EOF in scalar"}},
        StructureCase{"a: 'x\nb: 1\n", {"run.yaml:1:4: not valid YAML: the quote that opens here is never closed"}},
        StructureCase{"b: 1\na: \"x\n", {"run.yaml:2:4: not valid YAML: the quote that opens here is never closed"}},
        StructureCase{"\xef\xbb\xbf"
                      "a: 'it''s\n",
                      {"run.yaml:1:4: not valid YAML: the quote that opens here is never closed"}},
        StructureCase{"a: \"x\\\"\n", {"run.yaml:1:4: not valid YAML: the quote that opens here is never closed"}},
        StructureCase{"a: 'it''s'\nb: \"\\\"x\\\\\"\n", {}}, StructureCase{"a: ''\n", {}},
        StructureCase{"'a': \"\"\n\n", {}},
        StructureCase{"a:\n  b: 1\n\tc: 2\n",
                      {"run.yaml:3:1: not valid YAML: illegal tab when looking for indentation (lines must be indented "
                       "with spaces, not tabs)"}},
        StructureCase{"a: *x", {"run.yaml:1:4: not valid YAML: the referenced anchor is not defined"}},
        StructureCase{"a: &x [1, *x]", {"run.yaml:1:11: an alias must not stand inside the value that it names"}},
        StructureCase{"a: &x {b: {c: *x}}", {"run.yaml:1:15: an alias must not stand inside the value that it names"}},
        StructureCase{"a: 1\nb: {c: 1, d: 2, c: 3}\na: 2",
                      {"run.yaml:2:17: b.c: a key must not be given twice, first in line 2",
                       "run.yaml:3:1: a: a key must not be given twice, first in line 1"}},
        StructureCase{"l: [{x: 1}, {x: 1, \"x\": 2}]",
                      {"run.yaml:1:20: l[1].x: a key must not be given twice, first in line 1"}},
        StructureCase{"? [a, b]\n: 1\nc: 2", {"run.yaml:1:3: a key must be a word, got a list"}},
        StructureCase{"{{a: 1}: 2}", {"run.yaml:1:2: a key must be a word, got a map"}},
        StructureCase{"~: 2", {"run.yaml:1:1: a key must be a word, got nothing"}},
        StructureCase{"a: &x {b: 1}\nc: {<<: *x}", {std::string("run.yaml:2:5: c: ") + kMergeFault}},
        StructureCase{"a: !!python/object:os.system {b: 1}",
                      {"run.yaml:1:4: a: tags are not allowed, got tag:yaml.org,2002:python/object:os.system"}},
        StructureCase{"a: !!str 5", {"run.yaml:1:4: a: tags are not allowed, got tag:yaml.org,2002:str"}},
        StructureCase{"a: [1, !local 2]", {"run.yaml:1:8: a[1]: tags are not allowed, got !local"}},
        StructureCase{std::string("a: 1\nb: x\0y", 11), {"run.yaml:2:5: must be UTF-8 text, got the byte 0x00"}},
        StructureCase{"\x89PNG\r\n\x1a\n", {"run.yaml:1:1: must be UTF-8 text, got the byte 0x89"}},
        StructureCase{"a: \x1b[31m", {"run.yaml:1:4: must be UTF-8 text, got the byte 0x1b"}},
        StructureCase{"a: \xff", {"run.yaml:1:4: must be UTF-8 text, got the byte 0xff"}},
        StructureCase{"a: \xc0\xaf", {"run.yaml:1:4: must be UTF-8 text, got the byte 0xc0"}},
        StructureCase{"a: \xed\xa0\x80", {"run.yaml:1:4: must be UTF-8 text, got the byte 0xed"}},
        StructureCase{"a: \xe2\x82", {"run.yaml:1:4: must be UTF-8 text, got the byte 0xe2"}},
        StructureCase{std::string("\xff\xfe"
                                  "a\0:\0",
                                  6),
                      {"run.yaml:1:1: must be UTF-8 text, got the byte 0xff"}}));

TEST(ConfigDocument, NestingOf64IsAllowed) {
  EXPECT_THAT(structure_faults("a: " + repeated("[", 63) + repeated("]", 63)), IsEmpty());
  EXPECT_THAT(structure_faults("a: " + repeated("[", 64) + repeated("]", 64)),
              ElementsAre("run.yaml:1:67: must not nest deeper than 64"));
  const std::string twice = "a: &x " + repeated("[", 40) + repeated("]", 40) + "\nb: " + repeated("[", 30) + "*x";
  EXPECT_THAT(structure_faults(twice + repeated("]", 30)), ElementsAre("run.yaml:2:34: must not nest deeper than 64"));
}

TEST(ConfigDocument, TwoHundredThousandValuesAreAllowed) {
  EXPECT_THAT(structure_faults("a: [" + repeated("1,", 199990) + "]"), IsEmpty());
}

// ---------------------------------------------------------------- bombs: short work, one line

std::string deep_indentation(int depth) {
  std::string text;
  for (int i = 0; i < depth; ++i) text += std::string(static_cast<std::size_t>(i), ' ') + "a:\n";
  return text;
}

/// Each of `levels` lists names the one before `width` times.
std::string alias_tower(int levels, std::size_t width) {
  std::string text = "a0: &a0 [x]\n";
  for (int i = 1; i < levels; ++i) {
    const std::string name = std::string("a").append(std::to_string(i));
    const std::string inner = std::string("*a").append(std::to_string(i - 1)).append(", ");
    text.append(name).append(": &").append(name).append(" [").append(repeated(inner, width)).append("]\n");
  }
  return text;
}

struct Bomb {
  const char* name;
  std::function<std::string()> text;  ///< made where it is read: some are of 8 MB
  const char* fault;                  ///< part of the last line
};

class Bombs : public ::testing::TestWithParam<Bomb> {};

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double kPatience_s = 10;  // a sanitized build is several times slower
#else
constexpr double kPatience_s = 2;
#endif

TEST_P(Bombs, AreRefusedQuickly) {
  const std::string text = GetParam().text();
  const std::clock_t start = std::clock();  // CPU time: other work on the machine must not fail it
  const Lines faults = structure_faults(text);
  const double taken = static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
  ASSERT_FALSE(faults.empty());
  EXPECT_THAT(faults.back(), HasSubstr(GetParam().fault));
  EXPECT_EQ(faults.back().find('\n'), std::string::npos);
  EXPECT_LT(taken, kPatience_s);
}

const char* const kTooMuch = "must not hold more than 1000000 line breaks and punctuation marks";
const char* const kTooMany = "must not hold more than 200000 values, aliases followed";
const char* const kTooDeep = "must not nest deeper than 64";

INSTANTIATE_TEST_SUITE_P(
    Corpus, Bombs,
    ::testing::Values(
        Bomb{"OpenBrackets", [] { return repeated("[", 100000); }, kTooDeep},
        Bomb{"OpenBrackets8MiB", [] { return repeated("[", 8 << 20); }, kTooMuch},
        Bomb{"ClosedBrackets", [] { return "a: " + repeated("[", 4 << 20) + repeated("]", 4000000); }, kTooMuch},
        Bomb{"FewerBrackets", [] { return "a: " + repeated("[", 9000) + repeated("]", 9000); }, kTooDeep},
        Bomb{"OpenMaps", [] { return repeated("{a: ", 100000); }, kTooDeep},
        Bomb{"FewerMaps", [] { return repeated("{a: ", 9000); }, kTooDeep},
        Bomb{"BracketColons", [] { return repeated("[:", 4 << 20); }, kTooMuch},
        Bomb{"Dashes", [] { return repeated("- ", 100000); }, kTooDeep},
        Bomb{"Questions", [] { return repeated("? ", 100000); }, kTooDeep},
        Bomb{"Indentation", [] { return deep_indentation(3000); }, kTooDeep},
        Bomb{"AliasBomb", [] { return alias_tower(12, 10); }, kTooMany},
        Bomb{"AliasChain", [] { return alias_tower(3000, 1); }, kTooDeep},
        Bomb{"AliasedText", [] { return "a: &a " + repeated("x", 1000000) + "\nb: [" + repeated("*a, ", 1000) + "]"; },
             "must not hold more than 8 MiB of text, aliases followed"},
        Bomb{"ManyValues", [] { return "a: [" + repeated("1,", 4000000) + "]"; }, kTooMuch},
        Bomb{"FewerValues", [] { return "a: [" + repeated("1,", 900000) + "]"; }, kTooMany},
        Bomb{"Lines", [] { return "a: b" + repeated("\n", 8000000); }, kTooMuch},
        Bomb{"FewerDocuments", [] { return repeated("---\n", 900000); }, "must hold one YAML document"},
        Bomb{"ManyRepeats", [] { return "{" + repeated("a,", 4000000) + "}"; }, kTooMuch},
        Bomb{"FewerRepeats", [] { return "{" + repeated("a,", 990000) + "}"; },
             "too many faults, the reading ends here"},
        Bomb{"LongWord", [] { return "a: [" + repeated("x", 8000000); }, "end of sequence flow not found"},
        Bomb{"Anchors", [] { return repeated("&a ", 100000); }, "cannot assign multiple anchors"},
        Bomb{"Tags", [] { return repeated("!a ", 100000); }, "cannot assign multiple tags"},
        Bomb{"Documents", [] { return repeated("---\n", 2000000); }, kTooMuch},
        Bomb{"Quotes", [] { return repeated("\"", 8 << 20); }, kTooMuch}),
    [](const ::testing::TestParamInfo<Bomb>& bomb) { return std::string(bomb.param.name); });

// ---------------------------------------------------------------- files

class HostileFiles : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / ("config_hostile_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  /// The lines of the refusal, without the name of the file.
  Lines refusal(const std::filesystem::path& file) {
    const auto start = std::chrono::steady_clock::now();
    Lines lines;
    try {
      ConfigDocument::load(file);
    } catch (const ConfigError& error) {
      for (const Fault& fault : error.faults()) {
        EXPECT_EQ(fault.file, file.string());
        lines.push_back(fault.message);
      }
    }
    EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count(), kPatience_s);
    return lines;
  }

  std::filesystem::path folder_;
};

TEST_F(HostileFiles, LargeOnesAreRefusedUnread) {
  const auto file = folder_ / "large.yaml";
  std::ofstream(file) << "a: 1";
  std::filesystem::resize_file(file, 100u << 20);
  EXPECT_THAT(refusal(file), ElementsAre("must not be larger than 8 MiB, got 100.0 MiB"));
  std::filesystem::resize_file(file, (8u << 20) + 1);
  EXPECT_THAT(refusal(file), ElementsAre("must not be larger than 8 MiB, got 8.0 MiB"));
}

TEST_F(HostileFiles, EightMebibytesAreRead) {
  const auto file = folder_ / "full.yaml";
  std::ofstream(file) << "a: 1 #" << repeated("x", (8 << 20) - 6);
  EXPECT_EQ(std::filesystem::file_size(file), 8u << 20);
  EXPECT_NO_THROW(ConfigDocument::load(file));
}

TEST_F(HostileFiles, MissingOnesAndFoldersAreRefused) {
  EXPECT_THAT(refusal(folder_ / "none.yaml"), ElementsAre("cannot be opened: No such file or directory"));
  EXPECT_THAT(refusal(folder_ / "x" / "none.yaml"), ElementsAre("cannot be opened: No such file or directory"));
  EXPECT_THAT(refusal(folder_), ElementsAre("must be a file, got a directory"));
  EXPECT_THAT(refusal(""), ElementsAre("must be the name of a file, got an empty name"));
  EXPECT_THAT(refusal(std::string(5000, 'x')), ElementsAre("cannot be opened: File name too long"));
}

TEST_F(HostileFiles, PipesAndDevicesAreRefusedWithoutWaiting) {
  const auto pipe = folder_ / "pipe.yaml";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THAT(refusal(pipe), ElementsAre("must be a regular file, got a pipe, socket or device"));
  EXPECT_THAT(refusal("/dev/zero"), ElementsAre("must be a regular file, got a pipe, socket or device"));
}

TEST_F(HostileFiles, UnreadableOnesAreRefused) {
  const auto file = folder_ / "locked.yaml";
  std::ofstream(file) << "a: 1";
  std::filesystem::permissions(file, std::filesystem::perms::none);
  const tests::ObeyingPermissions even_root;
  EXPECT_THAT(refusal(file), ElementsAre("cannot be opened: Permission denied"));
}

TEST_F(HostileFiles, OddNamesStayOnOneLine) {
  try {
    ConfigDocument::load(folder_ / "a\nb\x1b.yaml");
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_EQ(std::string(error.what()),
              (folder_ / "a\\nb\\x1b.yaml").string() + ": cannot be opened: No such file or directory");
  }
}

TEST_F(HostileFiles, EmptyOnesAreRefused) {
  const auto file = folder_ / "empty.yaml";
  std::ofstream(file).flush();
  EXPECT_THAT(refusal(file), ElementsAre("must hold a map of keys, got an empty file"));
}

TEST(ConfigDocument, ParseAlsoKeepsToTheLimit) {
  EXPECT_THAT(structure_faults(repeated(" ", (8 << 20) + 1)), ElementsAre("run.yaml: must not be larger than 8 MiB"));
}

}  // namespace
}  // namespace evenglow::core
