#pragma once

#include <ctime>
#include <utility>

namespace evenglow::bench {

/// CPU seconds of the calling thread so far: other work on the machine does not count.
inline double thread_cpu_seconds() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// CPU seconds that `work` takes on this thread.
template <typename Work>
double cpu_seconds_of(Work&& work) {
  const double begin = thread_cpu_seconds();
  std::forward<Work>(work)();
  return thread_cpu_seconds() - begin;
}

}  // namespace evenglow::bench
