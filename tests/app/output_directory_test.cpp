#include "app/output_directory.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// What is written stays in the directory, in folders that are free.
namespace evenglow::tests {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::StartsWith;

class OutputDirectory : public ::testing::Test {
 protected:
  OutputDirectory() {
    write_text(folder_ / "tiny.yaml", kTinyRun);
    fs::create_directories(folder_ / "out");
    fs::create_directories(folder_ / "elsewhere");
  }
  ProgramResult run(const std::vector<std::string>& words) const { return evenglow(words, folder_.path()); }

  TempFolder folder_;
};

/// Names that a design writes to are links to a file of someone else.
TEST_F(OutputDirectory, LinksInItLeadNoWritingElsewhere) {
  write_text(folder_ / "elsewhere" / "mine", "mine");
  for (const char* name : {".evenglow-probe", "checkpoint.json.part", "checkpoint.previous.json.part",
                           "result.json.part", "density.csv.part", "report.html.part", "luminance.png.part"})
    fs::create_symlink("../elsewhere/mine", folder_ / "out" / name);
  const auto result = run({"design", "tiny.yaml", "-o", "out", "--quiet"});
  EXPECT_EQ(result.code, 0) << result.err;
  EXPECT_EQ(file_text(folder_ / "elsewhere" / "mine"), "mine");
  EXPECT_TRUE(fs::is_regular_file(fs::symlink_status(folder_ / "out" / "result.json")));
}

TEST_F(OutputDirectory, FoldersInItThatAreLinksAreRefused) {
  fs::create_directory_symlink("../elsewhere", folder_ / "out" / "dbef");
  for (const char* option : {"--quiet", "--overwrite", "--resume"}) {
    const auto result = run({"compare", "tiny.yaml", "-o", "out", option});
    EXPECT_EQ(result.code, 2);
    EXPECT_EQ(result.err, "out/dbef: must be a directory, got a symbolic link, which leads elsewhere\n");
  }
  EXPECT_EQ(run({"batch", "tiny.yaml", "-o", "out", "--quiet"}).code, 2);
  const auto resumed = run({"batch", "tiny.yaml", "-o", "out", "--simulate", "--resume"});
  EXPECT_EQ(resumed.code, 1) << "one run fails, the other is made";
  EXPECT_THAT(resumed.out, HasSubstr("must be a directory, got a symbolic link"));
  EXPECT_TRUE(fs::is_empty(folder_ / "elsewhere"));
}

TEST_F(OutputDirectory, ItselfMayBeALink) {
  fs::remove(folder_ / "out");
  fs::create_directory_symlink("elsewhere", folder_ / "out");
  EXPECT_EQ(run({"simulate", "tiny.yaml", "-o", "out", "--quiet"}).code, 0) << "the user has named it";
  EXPECT_TRUE(fs::exists(folder_ / "elsewhere" / "result.json"));
}

/// `...yaml` has the stem `..`: the folder above.
TEST_F(OutputDirectory, NamesOfDotsLeadNowhere) {
  EXPECT_EQ(app::output_directory({}, "a/phone.yaml"), fs::path("out/phone"));
  EXPECT_EQ(app::output_directory({}, "...yaml"), fs::path("out/run"));
  EXPECT_EQ(app::output_directory({}, "..yaml"), fs::path("out/run"));
  for (const char* name : {"...yaml", "..yaml"}) write_text(folder_ / name, kTinyRun);
  ASSERT_EQ(run({"simulate", "...yaml", "--quiet"}).code, 0);
  EXPECT_TRUE(fs::exists(folder_ / "out" / "run" / "result.json"));
  EXPECT_FALSE(fs::exists(folder_ / "result.json"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "result.json"));
  ASSERT_EQ(run({"batch", "...yaml", "..yaml", "--simulate", "--set", "variants=null", "-o", "b", "--quiet"}).code, 2);
  const auto compared = run({"compare", "...yaml", "..yaml", "-o", "c", "--quiet"});
  EXPECT_EQ(compared.code, 0) << compared.err;
  EXPECT_TRUE(fs::exists(folder_ / "c" / "run" / "result.json"));
  EXPECT_TRUE(fs::exists(folder_ / "c" / "run-2" / "result.json"));
}

/// Before hours are spent on the first variant.
TEST_F(OutputDirectory, OfAComparisonAllFoldersAreClaimedBeforeTheFirstPhoton) {
  fs::create_directories(folder_ / "out" / "dbef");
  const app::OutputLock busy(folder_ / "out" / "dbef");
  const auto result = run({"compare", "tiny.yaml", "-o", "out", "--quiet"});
  EXPECT_EQ(result.code, 2);
  EXPECT_THAT(result.err, StartsWith("out/dbef: must not be in use by another run"));
  EXPECT_FALSE(fs::exists(folder_ / "out" / "lpp" / "result.json"));
}

}  // namespace
}  // namespace evenglow::tests
