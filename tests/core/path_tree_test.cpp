#include "core/config/path_tree.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/core/config_reading.h"
#include "tests/support/temp_folder.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;

class PathTree : public ::testing::Test {
 protected:
  PathTree() {
    for (const char* place : {"top/runs/deep", "top/data", "other"})
      std::filesystem::create_directories(folder_ / place);
    for (const char* place : {"top/runs/a.csv", "top/runs/deep/a.csv", "top/data/a.csv", "other/a.csv", "a.csv"})
      tests::write_text(folder_ / place, "1\n");
  }

  /// The fault of a run file in top/runs that names this file.
  std::string fault_of(const std::string& text) const {
    tests::write_text(runs_ / "run.yaml", text);
    try {
      const ConfigDocument document = ConfigDocument::load(runs_ / "run.yaml");
      document.root().file({"table", "a table", std::string()});
      document.finish();
    } catch (const ConfigError& error) {
      return error.faults().front().to_string();
    }
    return "";
  }

  tests::TempFolder folder_;
  std::filesystem::path runs_ = folder_ / "top" / "runs";
};

TEST_F(PathTree, FilesOfTheRunAndOfTheFolderAboveAreTaken) {
  for (const char* name : {"a.csv", "deep/a.csv", "../data/a.csv", "deep/../a.csv", "../runs/a.csv"})
    EXPECT_EQ(fault_of(std::string("table: ") + name + "\n"), "") << name;
}

TEST_F(PathTree, WhatClimbsOutIsRefusedUnlessItIsAbsolute) {
  for (const char* name : {"../../a.csv", "../../other/a.csv", "../data/../../a.csv", "../../../../../../etc/passwd"}) {
    EXPECT_THAT(fault_of(std::string("table: ") + name + "\n"),
                HasSubstr("run.yaml:1:8: table: must stay in the folder above that of the run file"))
        << name;
  }
  EXPECT_EQ(fault_of("table: " + (folder_ / "other/a.csv").string() + "\n"), "");
}

TEST_F(PathTree, ALinkThatLeadsOutIsRefused) {
  std::filesystem::create_symlink(folder_ / "other", runs_ / "link");
  EXPECT_THAT(fault_of("table: link/a.csv\n"), HasSubstr("must stay in the folder above"));
}

TEST_F(PathTree, IncludedFilesKeepToTheTreeOfTheRunToo) {
  tests::write_text(folder_ / "top/part.yaml", "table: ../other/a.csv\n");
  EXPECT_THAT(fault_of("include: ../part.yaml\n"), HasSubstr("part.yaml:1:8: table: must stay in the folder above"));
  tests::write_text(folder_ / "top/part.yaml", "include: ../outer.yaml\n");
  tests::write_text(folder_ / "outer.yaml", "table: a.csv\n");
  EXPECT_THAT(fault_of("include: ../part.yaml\n"), HasSubstr("include: must stay in the folder above"));
  EXPECT_THAT(fault_of("include: ../../outer.yaml\n"), HasSubstr("include: must stay in the folder above"));
  EXPECT_EQ(fault_of("include: " + (folder_ / "outer.yaml").string() + "\n"), "") << "its own tree is its own";
}

}  // namespace
}  // namespace evenglow::core
