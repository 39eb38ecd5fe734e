#include "app/interrupt.h"

#include <ctime>

#include <ucontext.h>
#include <unistd.h>

#include "app/options.h"

namespace evenglow::app {
namespace {

sigset_t interrupts() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGINT);
  sigaddset(&set, SIGTERM);
  return set;
}

/// Runs only in a thread that does not block the signals, as some BLAS libraries start while they are loaded: blocks
/// them there from now on and sends the signal again, to the waiter.
void pass_on(int signal, siginfo_t* /*info*/, void* context) {
  sigset_t& mask = static_cast<ucontext_t*>(context)->uc_sigmask;
  sigaddset(&mask, SIGINT);
  sigaddset(&mask, SIGTERM);
  ::kill(::getpid(), signal);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  const sigset_t set = interrupts();
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  struct sigaction action {};
  action.sa_sigaction = pass_on;
  action.sa_flags = SA_SIGINFO | SA_RESTART;
  action.sa_mask = set;
  ::sigaction(SIGINT, &action, &old_int_);
  ::sigaction(SIGTERM, &action, &old_term_);
  waiter_ = std::jthread([this](const std::stop_token& end) {
    const sigset_t waited = interrupts();
    const timespec tick{0, 100'000'000};
    while (!end.stop_requested()) {
      if (sigtimedwait(&waited, nullptr, &tick) < 0) continue;
      if (source_.stop_requested()) _exit(kInterrupted);
      source_.request_stop();
    }
  });
}

InterruptGuard::~InterruptGuard() {
  waiter_.request_stop();
  waiter_.join();
  // A signal that comes too late to stop anything must not end the program by its default action.
  const sigset_t set = interrupts();
  const timespec none{0, 0};
  while (sigtimedwait(&set, nullptr, &none) > 0) {
  }
  ::sigaction(SIGINT, &old_int_, nullptr);
  ::sigaction(SIGTERM, &old_term_, nullptr);
  pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

}  // namespace evenglow::app
