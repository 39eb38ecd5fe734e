#include "app/batch_earlier.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "design/engine/state_file.h"
#include "tests/support/program.h"

namespace evenglow::app {
namespace {

class BatchEarlier : public ::testing::Test {
 protected:
  void write(const std::string& command) {
    design::BatchTable table{"t", "0.1.0", command, {}, {}};
    table.rows.resize(2);
    table.rows[0].name = "p1";
    table.rows[1].name = "p2";
    tests::write_text(folder_ / kBatchSummary, design::sealed_state(design::batch_json(table)));
  }
  tests::TempFolder folder_;
};

TEST_F(BatchEarlier, IsEmptyWhereThereWasNone) {
  EXPECT_TRUE(earlier_batch(folder_.path(), {}).rows.empty());
}

TEST_F(BatchEarlier, TracesDoNotGoOnAsDesigns) {
  write("evenglow batch a.yaml --simulate");
  Options options;
  options.resume = true;
  EXPECT_THROW(earlier_batch(folder_.path(), options), core::ConfigError);
  options.simulate = true;
  EXPECT_EQ(earlier_batch(folder_.path(), options).rows.size(), 2u);
}

TEST_F(BatchEarlier, WhatIsDamagedIsRefusedOnlyWhereItIsToGoOn) {
  tests::write_text(folder_ / kBatchSummary, "{");
  Options options;
  EXPECT_TRUE(earlier_batch(folder_.path(), options).rows.empty());
  options.resume = true;
  EXPECT_THROW(earlier_batch(folder_.path(), options), core::ConfigError);
}

TEST_F(BatchEarlier, FoldersThatAreNotOfThisBatchAreLeftOver) {
  write("evenglow batch a.yaml");
  for (const char* name : {"p1", "p2", "mine"}) std::filesystem::create_directory(folder_ / name);
  std::vector<PlannedRun> plan(1);
  plan[0].name = "p1";
  EXPECT_THAT(left_over(earlier_batch(folder_.path(), {}), plan, folder_.path()), ::testing::ElementsAre("p2"));
}

/// 20 MB of brackets must not cost a hundred times that.
TEST_F(BatchEarlier, OfDeepNestingIsRefused) {
  tests::write_text(folder_ / kBatchSummary, design::sealed_state("{\"a\":" + std::string(20'000'000, '[') + "}"));
  Options options;
  options.resume = true;
  EXPECT_THROW(earlier_batch(folder_.path(), options), core::ConfigError);
  tests::write_text(folder_ / kBatchSummary, std::string(40'000'000, '['));
  EXPECT_THROW(earlier_batch(folder_.path(), options), core::ConfigError) << "larger than any";
}

}  // namespace
}  // namespace evenglow::app
