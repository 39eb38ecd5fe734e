#include "core/parallel/ranks.h"

#include <atomic>
#include <chrono>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/thread_ranks.h"

/// Ranks as threads of this process: what MPI carries is in tests/app/mpi_test.cpp.
namespace evenglow::tests {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

using Results = std::vector<std::vector<double>>;
constexpr std::size_t kBatches = 37;

std::vector<double> result_of(std::size_t batch) {
  return std::vector<double>(batch % 5, 1.0 / static_cast<double>(batch + 1));
}

/// All batches by these ranks, and where each was made.
Results divided(core::RankGroup& ranks, std::vector<int>& makers, int slow_rank = -1) {
  Results results(kBatches);
  const auto own = ranks.run_batches(
      kBatches, 2,
      [&](std::size_t batch, const std::stop_token&) {
        if (ranks.rank() == slow_rank) std::this_thread::sleep_for(std::chrono::milliseconds(40));
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        results[batch] = result_of(batch);
      },
      {}, core::Agreement().add(7));
  EXPECT_TRUE(own);
  for (const std::size_t batch : *own) makers[batch] += 1;
  ranks.share(*own, results, {});
  return results;
}

TEST(RankGroup, EachBatchIsMadeOnceAndGivenToAll) {
  Results expected(kBatches);
  for (std::size_t i = 0; i < kBatches; ++i) expected[i] = result_of(i);
  for (const int count : {1, 2, 3, 4}) {
    std::vector<std::vector<int>> makers(static_cast<std::size_t>(count), std::vector<int>(kBatches, 0));
    on_ranks(count, [&](int rank, std::unique_ptr<core::RankLink> link) {
      core::RankGroup ranks(std::move(link));
      EXPECT_EQ(divided(ranks, makers[static_cast<std::size_t>(rank)]), expected);
      EXPECT_EQ(divided(ranks, makers[static_cast<std::size_t>(rank)]), expected) << "a second time";
      ranks.finish("", 0);
    });
    for (std::size_t batch = 0; batch < kBatches; ++batch) {
      int made = 0;
      for (const auto& of_rank : makers) made += of_rank[batch];
      EXPECT_EQ(made, 2);
    }
  }
}

TEST(RankGroup, ASlowRankGetsFewer) {
  std::vector<std::vector<int>> makers(3, std::vector<int>(kBatches, 0));
  on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    divided(ranks, makers[static_cast<std::size_t>(rank)], 1);
    ranks.finish("", 0);
  });
  const auto made = [&](int rank) {
    const auto& of_rank = makers[static_cast<std::size_t>(rank)];
    return std::accumulate(of_rank.begin(), of_rank.end(), 0);
  };
  EXPECT_EQ(made(0) + made(1) + made(2), static_cast<int>(kBatches));
  EXPECT_LT(made(1), made(0));
  EXPECT_LT(made(1), made(2));
}

TEST(RankGroup, AFailureIsToldAtAllRanksWithTheNumberOfTheRank) {
  std::vector<std::string> told(3);
  on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    try {
      ranks.run_batches(1000, 2,
                        [&](std::size_t, const std::stop_token&) {
                          std::this_thread::sleep_for(std::chrono::milliseconds(2));
                          if (rank == 2) throw core::Error("out of luck");
                        },
                        {}, {});
      ADD_FAILURE() << "rank " << rank;
    } catch (const core::Error& error) {
      told[static_cast<std::size_t>(rank)] = error.what();
    }
    ranks.finish(told[static_cast<std::size_t>(rank)], 1);
  });
  EXPECT_THAT(told, ElementsAre("rank 2: out of luck", "rank 2: out of luck", "out of luck"));
}

TEST(RankGroup, AStopAtOneRankStopsAll) {
  for (const int stopped : {0, 1}) {
    std::atomic<int> empty = 0, begun = 0;
    on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
      core::RankGroup ranks(std::move(link));
      std::stop_source stop;
      const auto own = ranks.run_batches(1000, 1,
                                         [&](std::size_t, const std::stop_token&) {
                                           if (++begun > 20 && rank == stopped) stop.request_stop();
                                           std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                         },
                                         stop.get_token(), {});
      empty += own ? 0 : 1;
      ranks.finish("", 130);
    });
    EXPECT_EQ(empty, 3);
    EXPECT_LT(begun, 900);
  }
}

TEST(RankGroup, RanksThatHaveComeApartEndWithAnError) {
  std::vector<std::string> told(2);
  on_ranks(2, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    try {
      ranks.run_batches(
          10, 1, [](std::size_t, const std::stop_token&) {}, {},
          core::Agreement().add(std::vector<double>{rank == 0 ? 0.5 : 0.5 + 1e-16 * 2}));
    } catch (const core::Error& error) {
      told[static_cast<std::size_t>(rank)] = error.what();
    }
    ranks.finish("", 0);
  });
  EXPECT_THAT(told[0], HasSubstr("rank 1 has come to other numbers than rank 0"));
  EXPECT_THAT(told[1], HasSubstr("rank 0 has come to other numbers than rank 1"));
}

TEST(RankGroup, ARankThatEndsEarlyTellsTheOthersWhy) {
  std::string told;
  on_ranks(2, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    if (rank == 0) return ranks.finish("cannot write out: No space left on device", 1);
    try {
      ranks.run_batches(10, 1, [](std::size_t, const std::stop_token&) {}, {}, {});
    } catch (const core::Error& error) {
      told = error.what();
    }
    ranks.finish(told, 1);
  });
  EXPECT_EQ(told, "rank 0: cannot write out: No space left on device");
}

TEST(RankGroup, ARankThatIsGoneIsNotWaitedForAfterAStop) {
  std::string told;
  on_ranks(2, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    if (rank == 1) return;
    std::stop_source stop;
    stop.request_stop();
    try {
      ranks.run_batches(10, 1, [](std::size_t, const std::stop_token&) {}, stop.get_token(), {});
    } catch (const core::RankLost& lost) {
      told = lost.what();
    }
    ranks.finish("", 1);
  });
  EXPECT_THAT(told, HasSubstr("does not answer"));
}

TEST(RankGroup, TextsComeInTheOrderOfTheRanks) {
  on_ranks(3, [&](int rank, std::unique_ptr<core::RankLink> link) {
    core::RankGroup ranks(std::move(link));
    EXPECT_THAT(ranks.texts(std::string(static_cast<std::size_t>(rank), 'x'), {}), ElementsAre("", "x", "xx"));
    ranks.finish("", 0);
  });
}

TEST(Agreement, EachBitAndEachPlaceCounts) {
  const auto of = [](const std::vector<double>& values) { return core::Agreement().add(values).value(); };
  EXPECT_NE(of({0.0}), of({-0.0}));
  EXPECT_NE(of({1.0, 2.0}), of({2.0, 1.0}));
  EXPECT_EQ(of({1.0, 2.0}), of({1.0, 2.0}));
}

}  // namespace
}  // namespace evenglow::tests
