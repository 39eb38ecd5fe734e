#include "app/run_context.h"

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/parallel/ranks.h"
#include "tests/app/tiny_run.h"
#include "tests/support/thread_ranks.h"

namespace evenglow::tests {
namespace {

using ::testing::HasSubstr;

class RunContext : public ::testing::Test {
 protected:
  RunContext() { write_text(folder_ / "tiny.yaml", kTinyRun); }
  app::Run read() const { return app::read_run(folder_ / "tiny.yaml", {}); }

  TempFolder folder_;
};

TEST_F(RunContext, ARunIsToldFromAnyOther) {
  std::set<std::string> identities;
  for (const char* command : {"design", "pareto", "optimize", "compare"})
    identities.insert(app::run_identity(read(), command));
  identities.insert(app::run_identity(read(), "design", 1));
  write_text(folder_ / "part.yaml", "x: 1\n");
  app::Run with_file = read();
  with_file.data_files.push_back(folder_ / "part.yaml");
  identities.insert(app::run_identity(with_file, "design"));
  write_text(folder_ / "part.yaml", "x: 2\n");
  identities.insert(app::run_identity(with_file, "design"));
  EXPECT_EQ(identities.size(), 7u);
  EXPECT_EQ(app::run_identity(read(), "design"), app::run_identity(read(), "design"));
}

/// Three ranks; the input of the last is that of the first, or another.
TEST_F(RunContext, RanksWithOtherInputAreRefusedByAll) {
  for (const bool same : {true, false}) {
    on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
      core::RankGroup ranks(std::move(link));
      app::Options options;
      options.ranks = &ranks;
      std::string told;
      try {
        app::agree_on_input(options, rank == 2 && !same ? "other" : "input", {});
      } catch (const core::ConfigError& error) {
        told = error.what();
      }
      if (same) {
        EXPECT_EQ(told, "") << rank;
      } else {
        EXPECT_THAT(told, HasSubstr("rank 2: must be given the input of rank 0")) << rank;
      }
      ranks.finish(told, told.empty() ? 0 : 2);
    });
  }
}

}  // namespace
}  // namespace evenglow::tests
