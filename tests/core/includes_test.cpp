#include "core/config/includes.h"

#include <filesystem>
#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "tests/core/config_reading.h"

namespace evenglow::core {
namespace {

using ::testing::ElementsAre;
using ::testing::EndsWith;
using ::testing::HasSubstr;

class IncludesTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) / ("includes_" + std::to_string(::getpid()));
    std::filesystem::create_directories(folder_ / "parts" / "data");
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) { std::ofstream(folder_ / name) << text; }

  Lines faults(const std::string& text) {
    write("run.yaml", text);
    try {
      const ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
      read_all(document.root());
      document.finish();
    } catch (const ConfigError& error) {
      return lines_of(error);
    }
    return {};
  }

  std::filesystem::path folder_;
};

TEST_F(IncludesTest, KeysOfTheFileCountUnlessTheMapHasThem) {
  write("parts/film.yaml", "kind: bef\naxis_deg: 0\npitch_um: 50\n");
  write("run.yaml", "films:\n  - {include: parts/film.yaml, axis_deg: 90}\n");
  const ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
  const ConfigNode film = document.root().maps("films", "")[0];
  EXPECT_EQ(film.text({"kind", "", {}}), "bef");
  EXPECT_DOUBLE_EQ(film.number({"axis_deg", "", Range::any(), {}}), 0.5 * 3.14159265358979323846);
  EXPECT_DOUBLE_EQ(film.number({"pitch_um", "", Range::any(), {}}), 0.05);
  EXPECT_FALSE(film.has("include"));
  EXPECT_NO_THROW(document.finish());
  EXPECT_EQ(document.files().front(), folder_ / "parts/film.yaml");
}

TEST_F(IncludesTest, FilesCountFromTheFolderOfTheFileThatNamesThem) {
  write("parts/film.yaml", "kind: dbef\ntable: data/film.csv\n");
  write("parts/data/film.csv", "1\n");
  write("own.csv", "2\n");
  write("run.yaml", "a: {include: parts/film.yaml}\nb: {include: parts/film.yaml, table: own.csv}\n");
  const ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
  for (const auto& [key, name] : {std::pair{"a", "parts/data/film.csv"}, {"b", "own.csv"}}) {
    const ConfigNode film = document.root().map(key, "");
    EXPECT_EQ(film.file({"table", "", {}}), folder_ / name);
    film.mark_read();
  }
  EXPECT_NO_THROW(document.finish());
}

TEST_F(IncludesTest, IncludedFilesMayIncludeAndFaultsNameTheirFile) {
  write("parts/inner.yaml", "pitch_um: fifty\n");
  write("parts/outer.yaml", "kind: bef\nshape: {include: inner.yaml}\n");
  write("run.yaml", "film: {include: parts/outer.yaml}\n");
  const ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
  const ConfigNode film = document.root().map("film", "");
  film.text({"kind", "", {}});
  film.map("shape", "").number({"pitch_um", "", Range::any(), {}});
  try {
    document.finish();
    FAIL();
  } catch (const ConfigError& error) {
    EXPECT_THAT(lines_of(error),
                ElementsAre(HasSubstr("parts/inner.yaml:1:11: film.shape.pitch_um: must be a number")));
  }
}

TEST_F(IncludesTest, UnreadKeysOfAPartAreFaults) {
  write("part.yaml", "kind: bef\ncolour: red\n");
  write("run.yaml", "film: {include: part.yaml}\n");
  const ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
  document.root().map("film", "").text({"kind", "", {}});
  EXPECT_THROW(document.finish(), ConfigError);
}

TEST_F(IncludesTest, WrongOnesAreRefused) {
  EXPECT_THAT(faults("a: {include: none.yaml}\n"), ElementsAre(HasSubstr("run.yaml:1:14: a.include: ")));
  EXPECT_THAT(faults("a: {include: [1]}\n"),
              ElementsAre(EndsWith("must be the name of a file that holds a map, got a list")));
  write("list.yaml", "[1, 2]\n");
  EXPECT_THAT(faults("a: {include: list.yaml}\n"),
              ElementsAre(EndsWith("must name a file that holds a map of keys, got a list")));
  write("self.yaml", "b: {include: self.yaml}\n");
  EXPECT_THAT(faults("a: {include: self.yaml}\n"), ElementsAre(HasSubstr("must not nest deeper than 8")));
  EXPECT_THAT(faults("a: {include: parts}\n"), ElementsAre(HasSubstr("a.include: ")));
}

TEST_F(IncludesTest, ManyAreRefusedSoon) {
  // Ten in each of eight levels would be 1e8.
  std::string many;
  for (const char name : std::string("abcdefghij")) (many += name) += ": {include: many.yaml}\n";
  write("many.yaml", many);
  const Lines found = faults("a: {include: many.yaml}\n");
  ASSERT_FALSE(found.empty());
  EXPECT_LE(found.size(), 101U);
  EXPECT_THAT(found, ::testing::Contains(HasSubstr("must not")));
}

/// Text that holds no values is read as well.
TEST_F(IncludesTest, TheirTextIsBoundedInAll) {
  std::string comments = "x: 1\n";
  while (comments.size() < 6'000'000) comments.append("# ").append(900, 'c').append("\n");
  write("comments.yaml", comments);
  std::string many;
  for (int i = 0; i < 150; ++i) many.append("k").append(std::to_string(i)).append(": {include: comments.yaml}\n");
  EXPECT_THAT(faults(many), ::testing::Contains(HasSubstr("k2.include: must not lead to more than 16 MiB of files")));
  EXPECT_EQ(faults("a: {include: comments.yaml}\nb: {include: comments.yaml}\n").size(), 0u);
}

TEST_F(IncludesTest, OverridesMayInclude) {
  write("part.yaml", "kind: lpp\n");
  write("run.yaml", "films: [{kind: dbef}]\n");
  ConfigDocument document = ConfigDocument::load(folder_ / "run.yaml");
  document.apply({"films[0]", "{include: part.yaml}", "--set"});
  EXPECT_EQ(document.root().maps("films", "")[0].text({"kind", "", {}}), "lpp");
}

}  // namespace
}  // namespace evenglow::core
