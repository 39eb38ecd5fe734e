#include "core/parallel/hand_out.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <thread>

#include "core/montecarlo/batches.h"
#include "core/parallel/batch_queue.h"

namespace evenglow::core {
namespace {

/// First word of a message.
enum Word : std::uint64_t {
  kWant,   ///< to rank 0: so many more batches, the second word
  kTake,   ///< from rank 0: batches, as many as words follow; none: there are no more
  kStop,   ///< from rank 0: a rank fails or is stopped
  kLeave,  ///< to rank 0: nothing more will be asked; the second word: 1 if for a stop
};

using Work = std::function<void(std::size_t, const std::stop_token&)>;

/// The threads of this rank, fed by a queue.
class Pool {
 public:
  Pool(int threads, const Work& work, const std::stop_token& stop)
      : threads_(static_cast<std::size_t>(effective_threads(threads))),
        passing_on_(stop, [this] { stop_.request_stop(); }),
        runner_([this, &work] { run(work); }) {}
  ~Pool() {
    end_early();
    queue.close();
    runner_.join();
  }
  Pool(const Pool&) = delete;
  Pool& operator=(const Pool&) = delete;

  void end_early() { stop_.request_stop(); }
  bool ending_early() const { return stop_.stop_requested(); }
  bool is_done() const { return done_; }
  std::size_t threads() const { return threads_; }
  std::size_t busy() const { return begun_ - ended_; }

  HandedOut outcome() {
    std::sort(made_.begin(), made_.end());
    return {std::move(made_), ending_early(), failure_};
  }

  BatchQueue queue;

 private:
  void run(const Work& work) {
    try {
      run_batches(threads_, static_cast<int>(threads_), [&](std::size_t) { serve(work); });
    } catch (...) {
      failure_ = std::current_exception();
      stop_.request_stop();
    }
    done_ = true;
  }

  void serve(const Work& work) {
    while (const auto batch = queue.pop()) {
      ++begun_;
      if (!ending_early()) make(work, *batch);
      ++ended_;
    }
  }

  /// A failure ends the other threads, too, whatever they wait for.
  void make(const Work& work, std::size_t batch) {
    try {
      work(batch, stop_.get_token());
    } catch (...) {
      stop_.request_stop();
      queue.clear();
      queue.close();
      throw;
    }
    const std::lock_guard lock(mutex_);
    made_.push_back(batch);
  }

  std::size_t threads_;
  std::stop_source stop_;
  std::stop_callback<std::function<void()>> passing_on_;
  std::atomic<std::size_t> begun_ = 0, ended_ = 0;
  std::atomic<bool> done_ = false;
  std::mutex mutex_;
  std::vector<std::size_t> made_;
  std::exception_ptr failure_;
  std::thread runner_;  // the last: it uses all above
};

void rest() {
  std::this_thread::sleep_for(std::chrono::microseconds(200));
}

/// Rank 0.
class Giver {
 public:
  Giver(RankLink& link, std::size_t count, Pool& pool) : link_(link), count_(count), pool_(pool) {}

  /// Until all others have left and the own threads have come to their end.
  void run(const std::stop_token& stop) {
    std::optional<std::chrono::steady_clock::time_point> stopped;
    while (present_ > 0 || !pool_.is_done()) {
      bool idle = true;
      while (const auto message = link_.poll()) {
        answer(*message);
        idle = false;
      }
      if (pool_.ending_early()) stop_all();
      feed_own();
      if (stop.stop_requested()) {
        const auto now = std::chrono::steady_clock::now();
        if (!stopped) stopped = now;
        if (now - *stopped > kPatience) throw RankLost("another rank has ended or does not answer: --resume goes on from the last whole step");
      }
      if (idle) rest();
    }
  }

 private:
  static constexpr std::chrono::milliseconds kPatience{600};  // mpirun waits 1 s between asking to end and killing

  void answer(const RankMessage& message) {
    if (message.words.at(0) == kLeave) {
      --present_;
      if (message.words.at(1) != 0) pool_.end_early();
      return;
    }
    std::vector<std::uint64_t> reply = {kTake};
    const std::uint64_t wanted = std::min<std::uint64_t>(message.words.at(1), RankLink::kMostWords - 1);
    while (!stopping_ && next_ < count_ && reply.size() <= wanted) reply.push_back(next_++);
    link_.send(message.from, reply);
  }

  void feed_own() {
    while (next_ < count_ && !stopping_ && pool_.queue.size() < pool_.threads()) pool_.queue.push(next_++);
    if (next_ >= count_ || stopping_) pool_.queue.close();
  }

  void stop_all() {
    if (stopping_) return;
    stopping_ = true;
    for (int i = 1; i < link_.count(); ++i) link_.send(i, {kStop});
  }

  RankLink& link_;
  std::size_t count_, next_ = 0;
  Pool& pool_;
  int present_ = link_.count() - 1;
  bool stopping_ = false;
};

/// Every other rank.
class Taker {
 public:
  Taker(RankLink& link, Pool& pool) : link_(link), pool_(pool) {}

  void run() {
    while (!pool_.is_done() || waiting_) {
      bool idle = true;
      while (const auto message = link_.poll()) {
        take(*message);
        idle = false;
      }
      if (pool_.ending_early()) close();
      ask();
      if (idle) rest();
    }
    link_.send(0, {kLeave, pool_.ending_early() ? 1ULL : 0ULL});
  }

 private:
  void take(const RankMessage& message) {
    if (message.words.at(0) == kStop) {
      pool_.end_early();
      return;
    }
    waiting_ = false;
    if (message.words.size() == 1) close();
    for (std::size_t i = 1; i < message.words.size() && !closed_; ++i) pool_.queue.push(message.words[i]);
  }

  void ask() {
    if (closed_ || waiting_) return;
    const std::size_t wanted = pool_.threads() + 1, at_hand = pool_.queue.size() + pool_.busy();
    if (at_hand >= wanted) return;
    link_.send(0, {kWant, wanted - at_hand});
    waiting_ = true;
  }

  void close() {
    closed_ = true;
    pool_.queue.close();
  }

  RankLink& link_;
  Pool& pool_;
  bool waiting_ = false, closed_ = false;
};

}  // namespace

HandedOut hand_out(RankLink& link, std::size_t count, int threads, const Work& work, const std::stop_token& stop) {
  Pool pool(threads, work, stop);
  if (link.rank() == 0) {
    Giver(link, count, pool).run(stop);
  } else {
    Taker(link, pool).run();
  }
  return pool.outcome();
}

}  // namespace evenglow::core
