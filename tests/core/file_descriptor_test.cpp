#include "core/base/file_descriptor.h"

#include <fcntl.h>
#include <gtest/gtest.h>

namespace evenglow::core {
namespace {

bool is_open(int number) {
  return ::fcntl(number, F_GETFD) != -1;
}

TEST(FileDescriptor, ClosesAtItsEnd) {
  int number = -1;
  {
    const FileDescriptor file(::open("/dev/null", O_RDONLY));
    number = file.number();
    ASSERT_TRUE(is_open(number));
  }
  EXPECT_FALSE(is_open(number));
}

TEST(FileDescriptor, IsClosedOnceWhenClosedBefore) {
  FileDescriptor file(::open("/dev/null", O_RDONLY));
  const int number = file.number();
  EXPECT_FALSE(file.close());
  EXPECT_FALSE(is_open(number));
  EXPECT_EQ(file.number(), -1);
}

TEST(FileDescriptor, TellsWhyClosingFailed) {
  FileDescriptor file(-1);
  EXPECT_EQ(file.close(), std::errc::bad_file_descriptor);
}

TEST(LastSystemError, IsThatOfTheLastCall) {
  EXPECT_EQ(::open("/nowhere/at/all", O_RDONLY), -1);
  EXPECT_EQ(last_system_error(), std::errc::no_such_file_or_directory);
}

}  // namespace
}  // namespace evenglow::core
