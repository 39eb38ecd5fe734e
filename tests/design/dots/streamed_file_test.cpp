#include "design/dots/streamed_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/program.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using design::StreamedFile;
using ::testing::HasSubstr;

TEST(StreamedFile, StandsInItsPlaceWhenWhole) {
  const TempFolder folder;
  write_text(folder / "a.txt", "old");
  {
    StreamedFile file(folder / "a.txt");
    file.write("one ");
    EXPECT_EQ(file_text(folder / "a.txt"), "old");
    file.write("two");
    file.finish();
  }
  EXPECT_EQ(file_text(folder / "a.txt"), "one two");
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}

TEST(StreamedFile, GivenUpLeavesNothing) {
  const TempFolder folder;
  { StreamedFile(folder / "a.txt").write("half"); }
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(StreamedFile, FollowsNoLink) {
  const TempFolder folder;
  write_text(folder / "victim", "mine");
  std::filesystem::create_symlink("victim", folder / "a.txt.part");
  StreamedFile file(folder / "a.txt");
  file.write("whole");
  file.finish();
  EXPECT_EQ(file_text(folder / "victim"), "mine");
  EXPECT_EQ(file_text(folder / "a.txt"), "whole");
}

TEST(StreamedFile, NamesThePathThatCannotBeWritten) {
  const TempFolder folder;
  try {
    StreamedFile file(folder / "none" / "a.txt");
    FAIL() << "no such folder";
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("none/a.txt: No such file or directory"));
  }
}

TEST(StreamedFile, AFolderInItsPlaceIsTold) {
  const TempFolder folder;
  std::filesystem::create_directories(folder / "a.txt" / "inner");
  StreamedFile file(folder / "a.txt");
  file.write("text");
  EXPECT_THROW(file.finish(), core::Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "a.txt.part"));
}

}  // namespace
}  // namespace evenglow::tests
