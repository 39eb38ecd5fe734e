#include "core/config/matrix_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/program.h"

namespace evenglow::core {
namespace {

using testing::HasSubstr;

class MatrixFile : public testing::Test {
 protected:
  std::filesystem::path file(const std::string& name, const std::string& text) {
    tests::write_text(folder_ / name, text);
    return folder_ / name;
  }
  std::string refusal(const std::string& text) {
    try {
      read_matrix_csv(file("map.csv", text), {0.0, 1.0, "a density in [0, 1]"});
    } catch (const ConfigError& error) {
      return error.faults().front().to_string();
    }
    return "";
  }
  tests::TempFolder folder_;
};

TEST_F(MatrixFile, ReadsRowsFromTheLowest) {
  const NumberMatrix map =
      read_matrix_csv(file("map.csv", "# comment\n0.1, 0.2,0.3\r\n0.4,0.5,0.6\n"), {0, 1, "a density"});
  EXPECT_EQ(map.nx, 3);
  EXPECT_EQ(map.ny, 2);
  EXPECT_EQ(map.values, (std::vector<double>{0.1, 0.2, 0.3, 0.4, 0.5, 0.6}));
}

TEST_F(MatrixFile, RefusesWithPlaceWhatIsNoMap) {
  EXPECT_THAT(refusal("0.1,0.2\n0.3,x\n"), HasSubstr("map.csv:2:5: must be a density in [0, 1], got"));
  EXPECT_THAT(refusal("0.1,1.5\n"), HasSubstr("map.csv:1:5: must be a density in [0, 1]"));
  EXPECT_THAT(refusal("0.1,nan\n"), HasSubstr("must be a density"));
  EXPECT_THAT(refusal("0.1,0.2\n0.3\n"), HasSubstr("must have 2 entries as the first row, got 1"));
  EXPECT_THAT(refusal("# nothing\n"), HasSubstr("must hold a matrix of numbers, got none"));
}

}  // namespace
}  // namespace evenglow::core
