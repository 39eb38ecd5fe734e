#include <algorithm>
#include <filesystem>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

/// The run files that come with the program are good.
namespace evenglow::tests {
namespace {

std::vector<std::filesystem::path> run_files(const std::string& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(EVENGLOW_SOURCE_DIR) + folder)) {
    const std::filesystem::path& file = entry.path();
    // A goniometer's file has its own command; its tests run it.
    if (file.extension() == ".yaml" && file.stem() != "dbef_goniometer") files.push_back(file);
  }
  std::sort(files.begin(), files.end());
  return files;
}

TEST(ShippedConfigs, AreGood) {
  std::size_t count = 0;
  for (const char* folder : {"/configs", "/configs/studies", "/examples/dbef_gain"}) {
    for (const auto& file : run_files(folder)) {
      const ProgramResult result = evenglow({"check", file.string()});
      EXPECT_EQ(result.code, 0) << file << '\n' << result.err;
      EXPECT_EQ(result.err, "") << file;
      ++count;
    }
  }
  EXPECT_GE(count, 10U);
}

/// Each part is good in a run of its own.
TEST(ShippedConfigs, PartsAreGood) {
  const TempFolder folder;
  for (const auto& file : run_files("/configs/parts")) {
    const std::string name = file.stem().string();
    const bool is_source = name.starts_with("led"), is_sheet = name.ends_with("sheet");
    const std::string include = "{include: '" + file.string() + "'}";
    const std::string led = "{kind: led_row}";
    std::string yaml = "evenglow: 1\nbacklight:\n  light_guide_plate: {thickness_mm: 2}\n  sources: [" +
                       (is_source ? include : led) + "]\n";
    if (is_sheet) yaml += "  reflectors: {bottom: " + include + "}\n";
    if (!is_source && !is_sheet) yaml += "  films: [" + include + "]\n";
    write_text(folder / (name + ".yaml"), yaml);
    const ProgramResult result = evenglow({"check", (folder / (name + ".yaml")).string()});
    EXPECT_EQ(result.code, 0) << file << '\n' << result.err;
  }
}

}  // namespace
}  // namespace evenglow::tests
