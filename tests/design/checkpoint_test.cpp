#include "design/engine/checkpoint.h"

#include <functional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/base/error.h"
#include "design/engine/state_file.h"
#include "tests/support/temp_folder.h"

namespace evenglow::design {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::ordered_json;

/// A state whose checksum is right, of numbers that no design writes: anyone can make one.
class Checkpoint : public ::testing::Test {
 protected:
  Checkpoint() {
    const core::CellGrid plate = core::CellGrid::over(3, 2, 0.0, 0.0, 30.0, 20.0);
    const core::CellGrid display = core::CellGrid::over(2, 2, 1.0, 1.0, 29.0, 19.0);
    bounds_ = {plate, display, 1000};
    DesignProgress progress;
    progress.steps.resize(2);
    progress.steps[1].step = 1;
    progress.density.cells = core::CellField(plate, 0.5);
    progress.best_density.cells = core::CellField(plate, 0.4);
    progress.start_luminance = core::CellField(display, 100.0);
    progress.photons = 1000;
    save_checkpoint(file_, "me", progress);
  }

  /// What is told of the state after a change and a new seal; empty: it is taken.
  std::string after(const std::function<void(Json&)>& change) const {
    Json object = Json::parse(unsealed_state(tests::file_text(file_)));
    change(object);
    const auto forged = folder_ / "forged.json";
    tests::write_text(forged, sealed_state(object.dump()));
    try {
      load_checkpoint(forged, "me", nullptr, &bounds_);
    } catch (const core::Error& error) {
      return error.what();
    }
    return "";
  }

  tests::TempFolder folder_;
  std::filesystem::path file_ = folder_ / "checkpoint.json";
  StateBounds bounds_;
};

TEST_F(Checkpoint, OfTheRunIsTaken) {
  EXPECT_EQ(after([](Json&) {}), "");
}

TEST_F(Checkpoint, OfOtherCellsIsRefused) {
  EXPECT_THAT(after([](Json& s) {
                s["density"]["frame"] = {0.0, 0.0, 0.0, 0.0};
              }),
              HasSubstr("forged.json: the checkpoint cannot be used (its density has other cells than the run file)"));
  const auto other_cells = [](const char* key) {
    return [key](Json& s) { s[key]["cells"] = {1, 1}, s[key]["values"] = {0.5}; };
  };
  EXPECT_THAT(after(other_cells("best_density")), HasSubstr("its density has other cells"));
  EXPECT_THAT(after(other_cells("start_luminance")), HasSubstr("its luminance has other cells"));
}

TEST_F(Checkpoint, OfNumbersThatNoDesignWritesIsRefused) {
  EXPECT_THAT(after([](Json& s) { s["density"]["values"][0] = -5.0; }), HasSubstr("its density leaves [0, 1]"));
  EXPECT_THAT(after([](Json& s) { s["best_density"]["values"][5] = 1.5; }), HasSubstr("its density leaves [0, 1]"));
  EXPECT_THAT(after([](Json& s) { s["start_luminance"]["values"][1] = -1.0; }), HasSubstr("luminance is negative"));
  EXPECT_THAT(after([](Json& s) { s["steps"][1]["step"] = 2'000'000'000; }), HasSubstr("do not count from 0"));
  EXPECT_THAT(after([](Json& s) { s["steps"] = Json::array(); }), HasSubstr("it holds no step"));
  EXPECT_THAT(after([](Json& s) { s["photons"] = 1001; }), HasSubstr("more photons than the run file"));
  EXPECT_THAT(after([](Json& s) { s["photons"] = 1'000'000'000'000'000; }), HasSubstr("too many photons"));
  EXPECT_THAT(after([](Json& s) { s["steps"][0]["photons"] = 1'000'000'000'000'000; }), HasSubstr("too many photons"));
  EXPECT_THAT(after([](Json& s) { s["best_rms"] = nullptr; }), HasSubstr("cannot be used"));
}

/// Its texts are printed: one that a stranger made could act on the terminal.
TEST_F(Checkpoint, OfTextsThatActOnATerminalIsRefused) {
  const std::string escape = "gone\x1b[31m";
  EXPECT_THAT(after([&](Json& s) { s["stop_reason"] = escape; }), HasSubstr("a text of it holds control characters"));
  EXPECT_THAT(after([&](Json& s) { s["level_note"] = "one\ntwo"; }), HasSubstr("control characters"));
  EXPECT_THAT(after([&](Json& s) { s["notes"] = {escape}; }), HasSubstr("control characters"));
  EXPECT_THAT(after([&](Json& s) { s["limit_notes"] = {"good", escape}; }), HasSubstr("control characters"));
  EXPECT_THAT(after([&](Json& s) { s["steps"][1]["updater"] = escape; }), HasSubstr("control characters"));
  EXPECT_EQ(after([&](Json& s) { s["stop_reason"] = "max_efficiency: \u00b5 is fine"; }), "");
}

TEST_F(Checkpoint, OfDeepNestingIsRefused) {
  std::string deep = R"({"format":)" + std::string(100000, '[') + std::string(100000, ']') + "}";
  tests::write_text(file_, sealed_state(deep));
  try {
    load_checkpoint(file_, "me");
    FAIL();
  } catch (const core::Error& error) {
    EXPECT_THAT(error.what(), HasSubstr("nests deeper than 32"));
  }
}

}  // namespace
}  // namespace evenglow::design
