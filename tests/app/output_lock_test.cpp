#include "app/output_lock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::app {
namespace {

namespace fs = std::filesystem;

TEST(OutputLock, TellsWhenItHasGoneWithItsDirectory) {
  const tests::TempFolder folder;
  fs::create_directory(folder / "out");
  const OutputLock lock(folder / "out");
  EXPECT_NO_THROW(lock.check());
  fs::rename(folder / "out", folder / "moved");
  EXPECT_THROW(lock.check(), core::Error);
  fs::create_directory(folder / "out");
  EXPECT_THROW(lock.check(), core::Error);
  const OutputLock another(folder / "out");
  EXPECT_NO_THROW(another.check());
  EXPECT_THROW(lock.check(), core::Error) << "the directory is of another run by now";
}

TEST(OutputLock, IsHeldOnce) {
  const tests::TempFolder folder;
  {
    const OutputLock lock(folder.path());
    EXPECT_THROW(OutputLock(folder.path()), core::ConfigError);
    EXPECT_THROW(check_not_in_use(folder.path()), core::ConfigError);
  }
  EXPECT_NO_THROW(check_not_in_use(folder.path()));
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace evenglow::app
