#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <stop_token>

/// The one door to TBB.
namespace evenglow::core {

/// Photons [first, first + count) of a run.
struct BatchRange {
  std::size_t batch = 0;
  std::uint64_t first = 0;
  std::uint64_t count = 0;
};

/// The i-th of `batches` equal batches of `photons` photons. `photons` must be a multiple of `batches`.
BatchRange batch_range(std::size_t batch, std::size_t batches, std::uint64_t photons);

/// Runs `work(i)` for i = 0 .. count - 1 on at most `threads` threads (0: all). The calls must be independent of
/// each other; whoever needs an order takes the results in the order of i afterwards. The first exception is thrown on.
/// After `stop` is requested no further call begins; returns whether all calls were made.
bool run_batches(std::size_t count, int threads, const std::function<void(std::size_t)>& work,
                 std::stop_token stop = {});

/// The number of threads that `threads` means on this machine (0: all).
int effective_threads(int threads);

/// CPU seconds used by this process so far, all threads.
double process_cpu_seconds();

}  // namespace evenglow::core
