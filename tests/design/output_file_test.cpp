#include "design/report/output_file.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/design/report_samples.h"
#include "tests/support/full_disk.h"

namespace evenglow::design {
namespace {

TEST(OutputFile, ReplacesTheWholeFile) {
  const samples::Folder folder("output");
  write_file(folder.path() / "a", "a long content\n");
  write_file(folder.path() / "a", std::string("b\0c", 3));
  EXPECT_EQ(samples::content(folder.path() / "a"), std::string("b\0c", 3));
}

TEST(OutputFile, FullDiskLeavesTheOldFileAsItWas) {
  const samples::Folder folder("full");
  write_file(folder.path() / "a", "old");
  {
    const tests::FullDisk full(1000);
    EXPECT_THROW(write_file(folder.path() / "a", std::string(5000, 'n')), core::Error);
  }
  EXPECT_EQ(samples::content(folder.path() / "a"), "old");
}

}  // namespace
}  // namespace evenglow::design
