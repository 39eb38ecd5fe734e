#include "app/rank_role.h"

#include <mutex>
#include <set>

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"
#include "tests/support/thread_ranks.h"

/// Ranks as threads of this process.
namespace evenglow::tests {
namespace {

namespace fs = std::filesystem;

TEST(RankRole, AloneChangesNothing) {
  core::RankGroup alone;
  app::Options options;
  options.out = "out";
  options.threads = 3;
  const app::RankRole role(alone, options, "out", {});
  EXPECT_EQ(role.options().ranks, nullptr);
  EXPECT_FALSE(role.options().helper);
  EXPECT_EQ(role.options().out, "out");
  EXPECT_EQ(role.options().threads, 3);
}

TEST(RankRole, HelpersHaveTheStateOfRankZeroInFoldersOfTheirOwn) {
  const TempFolder folder;
  fs::create_directories(folder / "out" / "lpp");
  write_text(folder / "out" / "lpp" / "checkpoint.json", "state");
  write_text(folder / "out" / "luminance.csv", "not needed");
  std::mutex mutex;
  std::set<fs::path> places;
  on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    app::Options options;
    options.resume = true;
    options.out = folder / "out";
    {
      const app::RankRole role(ranks, options, folder / "out", {});
      const app::Options& own = role.options();
      EXPECT_EQ(own.ranks, &ranks);
      EXPECT_EQ(own.helper, rank > 0);
      EXPECT_EQ(own.quiet, rank > 0);
      EXPECT_GE(own.threads, 1);
      EXPECT_EQ(file_text(own.out / "lpp" / "checkpoint.json"), "state");
      EXPECT_EQ(fs::exists(own.out / "luminance.csv"), rank == 0);
      const std::lock_guard lock(mutex);
      places.insert(own.out);
    }
    ranks.finish("", 0);
  });
  EXPECT_EQ(places.size(), 3u);
  for (const fs::path& place : places) EXPECT_EQ(fs::exists(place), place == folder / "out");
}

TEST(RankRole, AStateThatIsCutIsRefused) {
  const TempFolder folder;
  write_text(folder / "checkpoint.json", std::string(100, 'x'));
  const std::string bytes = app::packed_state(folder.path());
  const TempFolder other;
  EXPECT_THROW(app::unpack_state(bytes.substr(0, bytes.size() - 1), other.path()), std::exception);
  app::unpack_state(bytes, other.path());
  EXPECT_EQ(file_text(other / "checkpoint.json"), file_text(folder / "checkpoint.json"));
  EXPECT_EQ(app::packed_state(folder / "nowhere"), "");
}

/// As `packed_state` writes it, of any name.
std::string packed(const std::string& name, const std::string& content) {
  std::string bytes;
  for (const std::string& part : {name, content}) {
    const std::uint64_t size = part.size();
    bytes.append(reinterpret_cast<const char*>(&size), sizeof(size));
    bytes += part;
  }
  return bytes;
}

TEST(RankRole, StatesThatLeaveTheFolderAreRefused) {
  const TempFolder folder;
  const fs::path own = folder / "a" / "own";
  fs::create_directories(own);
  for (const std::string name :
       {"../checkpoint.json", "../../checkpoint.json", "./checkpoint.json", "/checkpoint.json", "x/../checkpoint.json",
        "x/y/checkpoint.json", "authorized_keys", "result.json", "checkpoint_x.json", "..", "../", "x/", ""}) {
    EXPECT_THROW(app::unpack_state(packed(name, "x"), own), core::Error) << name;
  }
  EXPECT_THROW(app::unpack_state(packed((folder / "checkpoint.json").string(), "x"), own), core::Error);
  EXPECT_TRUE(fs::is_empty(own));
  for (const std::string name : {"checkpoint.json", "checkpoint.previous.json", "checkpoint_12.json", "batch.json",
                                 "lpp/checkpoint_1.previous.json"}) {
    app::unpack_state(packed(name, "state"), own);
    EXPECT_EQ(file_text(own / name), "state") << name;
  }
}

TEST(RankRole, LinksAndOtherFilesAreNotSent) {
  const TempFolder folder;
  fs::create_directories(folder / "elsewhere" / "out");
  const fs::path out = folder / "elsewhere" / "out";
  write_text(folder / "checkpoint.json", "secret");
  write_text(out / "keys.json", "secret");
  fs::create_symlink("../../checkpoint.json", out / "checkpoint.json");
  fs::create_directory_symlink("../..", out / "lpp");
  EXPECT_EQ(app::packed_state(out), "");
}

}  // namespace
}  // namespace evenglow::tests
