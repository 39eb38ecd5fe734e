#include "design/engine/state_file.h"

#include <random>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/temp_folder.h"

namespace evenglow::design {
namespace {

using ::testing::HasSubstr;

class StateFile : public ::testing::Test {
 protected:
  StateFile() {
    save_state(file_, R"({"step":1})");
    save_state(file_, R"({"step":2})");
  }

  /// The state that counts, or what is told.
  std::string loaded(std::string* note = nullptr) const {
    std::string object, told;
    try {
      if (!load_state(
              file_, [&](const std::string& text) { object = text; }, told))
        return "none";
    } catch (const core::Error& error) {
      return error.what();
    }
    if (note != nullptr) *note = told;
    return object;
  }

  tests::TempFolder folder_;
  std::filesystem::path file_ = folder_ / "checkpoint.json";
  std::filesystem::path previous_ = folder_ / "checkpoint.previous.json";
};

TEST_F(StateFile, GivesBackTheNewest) {
  std::string note = "x";
  EXPECT_EQ(loaded(&note), R"({"step":2})");
  EXPECT_EQ(note, "");
  EXPECT_EQ(unsealed_state(tests::file_text(previous_)), R"({"step":1})");
  EXPECT_EQ(previous_state(file_), previous_);
  remove_state(file_);
  EXPECT_EQ(loaded(), "none");
}

TEST_F(StateFile, EveryFlippedByteIsFoundAndTheOneBeforeIsUsed) {
  const std::string good = tests::file_text(file_);
  std::mt19937 random(1);
  for (int i = 0; i < 100; ++i) {
    std::string bad = good;
    bad[random() % bad.size()] ^= static_cast<char>(1u << random() % 8);
    tests::write_text(file_, bad);
    std::string note;
    ASSERT_EQ(loaded(&note), R"({"step":1})") << bad;
    EXPECT_THAT(note, HasSubstr("the one of the step before is used, checkpoint.previous.json"));
  }
}

TEST_F(StateFile, EveryCutIsFound) {
  const std::string good = tests::file_text(file_);
  for (std::size_t size = 0; size < good.size(); ++size) {
    tests::write_text(file_, good.substr(0, size));
    ASSERT_EQ(loaded(), R"({"step":1})") << size;
  }
  std::filesystem::remove(file_);
  EXPECT_EQ(loaded(), R"({"step":1})");
}

TEST_F(StateFile, OfTwoBadOnesTheNewestIsTold) {
  tests::write_text(file_, "x");
  tests::write_text(previous_, "y");
  EXPECT_THAT(loaded(), HasSubstr("checkpoint.json: the checkpoint cannot be used (it has no checksum"));
  EXPECT_EQ(tests::file_text(file_), "x");
}

/// A damaged state that was gone back from must not push the good one out.
TEST_F(StateFile, SavingKeepsTheGoodOneBeforeADamagedNewest) {
  tests::write_text(file_, "damaged");
  save_state(file_, R"({"step":3})");
  EXPECT_EQ(unsealed_state(tests::file_text(file_)), R"({"step":3})");
  EXPECT_EQ(unsealed_state(tests::file_text(previous_)), R"({"step":1})");
}

}  // namespace
}  // namespace evenglow::design
