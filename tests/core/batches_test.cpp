#include "core/montecarlo/batches.h"

#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "core/base/error.h"

namespace evenglow::core {
namespace {

TEST(Batches, RangesCoverAllPhotonsOnce) {
  std::uint64_t next = 0;
  for (std::size_t i = 0; i < 7; ++i) {
    const BatchRange range = batch_range(i, 7, 7000);
    EXPECT_EQ(range.batch, i);
    EXPECT_EQ(range.first, next);
    EXPECT_EQ(range.count, 1000U);
    next += range.count;
  }
  EXPECT_EQ(next, 7000U);
  EXPECT_THROW(batch_range(0, 7, 7001), Error);
  EXPECT_THROW(batch_range(0, 0, 0), Error);
}

TEST(Batches, EachIsRunOnce) {
  for (const int threads : {1, 2, 4, 0}) {
    std::vector<std::atomic<int>> runs(200);
    EXPECT_TRUE(run_batches(runs.size(), threads, [&](std::size_t i) { ++runs[i]; }));
    for (const auto& count : runs) EXPECT_EQ(count, 1);
  }
  EXPECT_TRUE(run_batches(0, 1, [](std::size_t) { FAIL(); }));
}

TEST(Batches, NoMoreThreadsThanAsked) {
  std::atomic<int> now = 0, most = 0;
  run_batches(64, 2, [&](std::size_t) {
    const int running = ++now;
    int seen = most;
    while (running > seen && !most.compare_exchange_weak(seen, running)) {
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
    --now;
  });
  EXPECT_LE(most, 2);
}

TEST(Batches, ExceptionsComeThrough) {
  const auto work = [](std::size_t i) {
    if (i == 3) throw std::runtime_error("three");
  };
  EXPECT_THROW(run_batches(10, 2, work), std::runtime_error);
}

TEST(Batches, StopEndsTheRunEarly) {
  std::stop_source stop;
  std::atomic<int> runs = 0;
  const bool complete = run_batches(
      100, 1,
      [&](std::size_t) {
        if (++runs == 5) stop.request_stop();
      },
      stop.get_token());
  EXPECT_FALSE(complete);
  EXPECT_EQ(runs, 5);
}

TEST(Batches, ThreadsAndTime) {
  EXPECT_EQ(effective_threads(3), 3);
  EXPECT_GE(effective_threads(0), 1);
  const double before = process_cpu_seconds();
  while (process_cpu_seconds() < before + 1e-3) {
  }  // it moves while we work
}

}  // namespace
}  // namespace evenglow::core
