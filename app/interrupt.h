#pragma once

#include <csignal>
#include <stop_token>
#include <thread>

namespace evenglow::app {

/// While it lives, Ctrl-C and SIGTERM ask for a stop instead of ending the program; a second one ends it at once.
/// Made in main before the program's own threads, so that they all leave these signals to it; threads that a library
/// started earlier pass them on.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  std::stop_token token() const { return source_.get_token(); }

 private:
  std::stop_source source_;
  struct sigaction old_int_ {};
  struct sigaction old_term_ {};
  std::jthread waiter_;
};

}  // namespace evenglow::app
