#pragma once

#include <algorithm>

#include <gtest/gtest.h>

#include "tests/app/tiny_run.h"

namespace evenglow::tests {

/// A folder with tiny.yaml without variants, and the program in it.
class BatchFixture : public ::testing::Test {
 protected:
  BatchFixture() {
    std::string text = kTinyRun;
    text.erase(text.find("variants:"), text.find("trace:") - text.find("variants:"));
    base_ = text;
    write_text(folder_ / "tiny.yaml", text);
  }

  ProgramResult run(const std::vector<std::string>& words) const { return evenglow(words, folder_.path()); }
  nlohmann::ordered_json summary(const std::string& out) const { return json_of(folder_ / out / "batch.json"); }

  static std::size_t done(const nlohmann::ordered_json& table) {
    return static_cast<std::size_t>(std::count_if(table["runs"].begin(), table["runs"].end(),
                                                  [](const auto& row) { return row["status"] == "done"; }));
  }

  TempFolder folder_;
  std::string base_;
};

}  // namespace evenglow::tests
