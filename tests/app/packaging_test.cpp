#include <algorithm>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// What is installed beside the program says what the program says.
namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

const std::filesystem::path kPackaging = std::filesystem::path(EVENGLOW_SOURCE_DIR) / "packaging";

/// The commands that `evenglow --help` lists.
std::vector<std::string> commands() {
  std::istringstream help(evenglow({"--help"}).out);
  std::vector<std::string> names;
  bool listed = false;
  for (std::string line; std::getline(help, line);) {
    if (line.starts_with("Commands:")) {
      listed = true;
    } else if (line.empty()) {
      listed = false;
    } else if (listed && line.size() > 3 && line[2] != ' ') {
      names.push_back(line.substr(2, line.find(' ', 2) - 2));
    }
  }
  return names;
}

TEST(Packaging, TheManualPageListsEveryCommandAndNoOther) {
  const std::string page = file_text(kPackaging / "evenglow.1");
  std::vector<std::string> told;
  std::istringstream lines(page.substr(page.find(".SH COMMANDS")));
  for (std::string line; std::getline(lines, line) && line.find(".SH EXIT") != 0;) {
    if (line.starts_with(".B ")) told.push_back(line.substr(3));
  }
  std::vector<std::string> known = commands();
  ASSERT_GE(known.size(), 6u);
  std::sort(told.begin(), told.end());
  std::sort(known.begin(), known.end());
  EXPECT_EQ(told, known);
}

/// The words that bash would offer.
std::string completed(const std::string& words, int at) {
  const std::string program = EVENGLOW_PROGRAM;
  const std::string script = "source '" + (kPackaging / "evenglow.bash").string() + "'; COMP_WORDS=('" + program +
                             "' " + words + "); COMP_CWORD=" + std::to_string(at) +
                             "; _evenglow; echo \"${COMPREPLY[*]}\"";
  return run_program({"/bin/bash", "-c", script}).out;
}

TEST(Packaging, BashCompletesCommandsAndOptions) {
  EXPECT_EQ(completed("desi", 1), "design\n");
  EXPECT_THAT(completed("''", 1), HasSubstr(" compare "));
  EXPECT_EQ(completed("design --see", 2), "--seed\n");
  EXPECT_THAT(completed("film gon", 2), HasSubstr("goniometer"));
}

}  // namespace
}  // namespace evenglow::tests
