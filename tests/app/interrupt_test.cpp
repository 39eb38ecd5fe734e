#include "app/interrupt.h"

#include <chrono>
#include <csignal>
#include <thread>

#include <gtest/gtest.h>
#include <unistd.h>

namespace evenglow::app {
namespace {

bool stops_soon(const std::stop_token& token) {
  for (int i = 0; i < 5000 && !token.stop_requested(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  return token.stop_requested();
}

TEST(InterruptGuard, ASignalAsksForAStop) {
  for (const int signal : {SIGINT, SIGTERM}) {
    const InterruptGuard guard;
    EXPECT_FALSE(guard.token().stop_requested());
    ::kill(::getpid(), signal);
    EXPECT_TRUE(stops_soon(guard.token()));
  }
}

TEST(InterruptGuard, AThreadThatWasThereBeforePassesTheSignalOn) {
  std::jthread earlier([](const std::stop_token& end) {
    while (!end.stop_requested()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  });
  const InterruptGuard guard;
  ::pthread_kill(earlier.native_handle(), SIGINT);
  EXPECT_TRUE(stops_soon(guard.token()));
}

TEST(InterruptGuard, LeavesTheSignalsAsItFoundThem) {
  struct sigaction before {};
  struct sigaction after {};
  ::sigaction(SIGINT, nullptr, &before);
  { const InterruptGuard guard; }
  ::sigaction(SIGINT, nullptr, &after);
  EXPECT_EQ(before.sa_handler, after.sa_handler);
  sigset_t mask;
  pthread_sigmask(SIG_BLOCK, nullptr, &mask);
  EXPECT_EQ(sigismember(&mask, SIGINT), 0);
  EXPECT_EQ(sigismember(&mask, SIGTERM), 0);
}

}  // namespace
}  // namespace evenglow::app
