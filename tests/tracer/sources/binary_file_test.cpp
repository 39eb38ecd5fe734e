#include "tracer/sources/binary_file.h"

#include <array>

#include <gtest/gtest.h>
#include <sys/stat.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::tests {
namespace {

using tracer::BinaryFile;

TEST(BinaryFile, ReadsAtAnyPlace) {
  const TempFolder folder;
  write_text(folder / "f", "abcdefgh");
  const BinaryFile file(folder / "f");
  EXPECT_EQ(file.size(), 8u);
  std::array<std::byte, 3> bytes{};
  file.read(4, bytes);
  EXPECT_EQ(static_cast<char>(bytes[0]), 'e');
  EXPECT_EQ(static_cast<char>(bytes[2]), 'g');
}

TEST(BinaryFile, AFileThatHasBecomeShorterIsNoCrash) {
  const TempFolder folder;
  write_text(folder / "f", "abcdefgh");
  const BinaryFile file(folder / "f");
  std::filesystem::resize_file(folder / "f", 5);
  std::array<std::byte, 3> bytes{};
  EXPECT_NO_THROW(file.read(2, bytes));
  EXPECT_THROW(file.read(4, bytes), core::Error);
}

TEST(BinaryFile, RefusesWhatIsNoRegularFile) {
  const TempFolder folder;
  EXPECT_THROW(BinaryFile(folder / "none"), core::ConfigError);
  EXPECT_THROW(BinaryFile(folder.path()), core::ConfigError);
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_THROW(BinaryFile(folder / "pipe"), core::ConfigError);
}

}  // namespace
}  // namespace evenglow::tests
