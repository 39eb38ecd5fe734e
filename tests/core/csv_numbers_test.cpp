#include "core/config/csv_numbers.h"

#include <array>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include "core/base/error.h"

namespace evenglow::core {
namespace {

using ::testing::HasSubstr;

long peak_kib() {
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss;
}

std::string fault_of(const std::string& text) {
  std::array<CsvColumn, 2> columns;
  columns[0].name = "a";
  columns[1].name = "b";
  try {
    CsvNumbers::parse(text, "t.csv", columns, {});
  } catch (const ConfigError& error) {
    return error.what();
  }
  return "";
}

/// A line of commas must not cost many times its size.
TEST(CsvNumbers, ALineOfCommasIsRefusedInLittleMemory) {
  const std::string commas(20'000'000, ',');
  const std::string row = "a,b\n1,2\n" + commas + '\n';
  const std::string header = commas + '\n';
  const long before = peak_kib();
  EXPECT_EQ(fault_of("a,b\n1,2\n"), "");
  EXPECT_THAT(fault_of(row), HasSubstr("t.csv:3:1: must have 2 entries as the header (line 1), got 20000001"));
  EXPECT_THAT(fault_of(header), HasSubstr("columns must be a,b, got ''"));
  EXPECT_LT(peak_kib() - before, 100'000);
}

TEST(CsvNumbers, ALineWithOneEntryMoreIsRefused) {
  EXPECT_THAT(fault_of("a,b\n1,2,3\n"), HasSubstr("must have 2 entries as the header (line 1), got 3"));
  EXPECT_THAT(fault_of("a,b\n1\n"), HasSubstr("got 1"));
  EXPECT_THAT(fault_of("a,b,b\n1,2,3\n"), HasSubstr("must be named once"));
  EXPECT_THAT(fault_of("a,b,c\n1,2,3\n"), HasSubstr("columns must be a,b, got 'c'"));
}

}  // namespace
}  // namespace evenglow::core
