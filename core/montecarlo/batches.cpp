#include "core/montecarlo/batches.h"

#include <atomic>
#include <ctime>
#include <exception>
#include <thread>
#include <vector>

#include <tbb/info.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include "core/base/error.h"

namespace evenglow::core {

BatchRange batch_range(std::size_t batch, std::size_t batches, std::uint64_t photons) {
  expects(batches > 0 && photons % batches == 0, "photons are a multiple of the batches");
  const std::uint64_t count = photons / batches;
  return {batch, count * batch, count};
}

namespace {

/// Calls `next` for each number below `count`, on so many threads.
void share_out(std::size_t count, int threads, const std::function<void(std::size_t)>& next) {
#if defined(__SANITIZE_THREAD__)
  // TBB is not instrumented: the sanitizer cannot see how it hands work over, and would take every use of what a batch
  // shares with its maker for a race. Threads of the standard library it sees.
  std::atomic<std::size_t> taken = 0;
  const auto work = [&] {
    for (std::size_t i = taken++; i < count; i = taken++) next(i);
  };
  std::vector<std::exception_ptr> failures(static_cast<std::size_t>(threads));
  {
    std::vector<std::jthread> workers;
    for (std::exception_ptr& failure : failures) {
      workers.emplace_back([&work, &failure] {
        try {
          work();
        } catch (...) {
          failure = std::current_exception();
        }
      });
    }
  }
  for (const std::exception_ptr& failure : failures) {
    if (failure) std::rethrow_exception(failure);
  }
#else
  tbb::task_arena arena(threads);
  arena.execute([&] {
    // A grain of one batch: batches are few and long, and their lengths differ.
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) next(i);
        },
        tbb::simple_partitioner());
  });
#endif
}

}  // namespace

bool run_batches(std::size_t count, int threads, const std::function<void(std::size_t)>& work, std::stop_token stop) {
  std::atomic<std::size_t> done = 0;
  share_out(count, effective_threads(threads), [&](std::size_t i) {
    if (stop.stop_requested()) return;
    work(i);
    ++done;
  });
  return done == count;
}

int effective_threads(int threads) {
  return threads > 0 ? threads : tbb::info::default_concurrency();
}

double process_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

}  // namespace evenglow::core
