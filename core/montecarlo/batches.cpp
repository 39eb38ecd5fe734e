#include "core/montecarlo/batches.h"

#include <atomic>
#include <ctime>

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

bool run_batches(std::size_t count, int threads, const std::function<void(std::size_t)>& work, std::stop_token stop) {
  std::atomic<std::size_t> done = 0;
  // What was written before is seen by all threads: so it is by TBB, and so tools see it that do not look into TBB.
  std::atomic<bool> begun = false;
  begun.store(true, std::memory_order_release);
  tbb::task_arena arena(effective_threads(threads));
  arena.execute([&] {
    // A grain of one batch: batches are few and long, and their lengths differ.
    tbb::parallel_for(
        tbb::blocked_range<std::size_t>(0, count, 1),
        [&](const tbb::blocked_range<std::size_t>& range) {
          for (std::size_t i = range.begin(); i != range.end(); ++i) {
            if (!begun.load(std::memory_order_acquire) || stop.stop_requested()) return;
            work(i);
            ++done;
          }
        },
        tbb::simple_partitioner());
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
