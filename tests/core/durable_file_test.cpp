#include "core/base/durable_file.h"

#include <functional>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/full_disk.h"
#include "tests/support/permissions.h"
#include "tests/support/temp_folder.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;

std::string message_of(const std::function<void()>& act) {
  try {
    act();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::size_t files_in(const std::filesystem::path& folder) {
  return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder), {}));
}

TEST(DurableFile, ReplacesAWholeFile) {
  const tests::TempFolder folder;
  write_durably(folder / "a", "one");
  write_durably(folder / "a", "two");
  EXPECT_EQ(tests::file_text(folder / "a"), "two");
  EXPECT_EQ(files_in(folder.path()), 1u);
}

TEST(DurableFile, KeepsTheOneBefore) {
  const tests::TempFolder folder;
  for (const char* text : {"one", "two", "three"}) write_durably_keeping(folder / "a", folder / "b", text);
  EXPECT_EQ(tests::file_text(folder / "a"), "three");
  EXPECT_EQ(tests::file_text(folder / "b"), "two");
  EXPECT_EQ(files_in(folder.path()), 2u);
}

TEST(DurableFile, AFullDiskIsToldAndTheOldFilesStay) {
  const tests::TempFolder folder;
  write_durably_keeping(folder / "a", folder / "b", "one");
  write_durably_keeping(folder / "a", folder / "b", "two");
  const std::string large(100'000, 'x');
  {
    const tests::FullDisk full(50'000);
    const auto told = message_of([&] { write_durably_keeping(folder / "a", folder / "b", large); });
    EXPECT_THAT(told, HasSubstr("cannot write " + (folder / "a").string() + ": File too large"));
    EXPECT_THAT(message_of([&] { prove_writable(folder.path(), 100'000); }), HasSubstr("File too large"));
  }
  EXPECT_EQ(tests::file_text(folder / "a"), "two");
  EXPECT_EQ(tests::file_text(folder / "b"), "one");
  EXPECT_EQ(files_in(folder.path()), 2u) << "nothing half is left";
}

TEST(DurableFile, AReadOnlyOrMissingFolderIsTold) {
  const tests::ObeyingPermissions obeying;
  const tests::TempFolder folder;
  const auto place = folder / "place";
  EXPECT_THAT(message_of([&] { write_durably(place / "a", "x"); }), HasSubstr("No such file or directory"));
  std::filesystem::create_directory(place);
  std::filesystem::permissions(place, std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
  EXPECT_THAT(message_of([&] { write_durably(place / "a", "x"); }), HasSubstr("Permission denied"));
  EXPECT_THAT(message_of([&] { prove_writable(place, 10); }), HasSubstr("Permission denied"));
  std::filesystem::permissions(place, std::filesystem::perms::owner_all);
}

/// A link that waits at the name of a file to come leads no writing elsewhere.
TEST(DurableFile, LinksAreNotFollowed) {
  const tests::TempFolder folder;
  std::filesystem::create_directory(folder / "out");
  tests::write_text(folder / "victim", "mine");
  for (const char* name : {"a", "a.part", "b", "b.part", ".evenglow-probe"})
    std::filesystem::create_symlink("../victim", folder / "out" / name);
  prove_writable(folder / "out", 100);
  write_durably(folder / "out" / "a", "one");
  std::filesystem::create_symlink("../victim", folder / "out" / "a.part");
  write_durably_keeping(folder / "out" / "a", folder / "out" / "b", "two");
  EXPECT_EQ(tests::file_text(folder / "victim"), "mine");
  EXPECT_EQ(tests::file_text(folder / "out" / "a"), "two");
  EXPECT_EQ(tests::file_text(folder / "out" / "b"), "one");
  EXPECT_FALSE(std::filesystem::is_symlink(folder / "out" / "a"));
  EXPECT_EQ(files_in(folder / "out"), 2u);
}

}  // namespace
}  // namespace evenglow::core
