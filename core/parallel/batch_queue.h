#pragma once

#include <condition_variable>
#include <cstddef>
#include <deque>
#include <mutex>
#include <optional>

namespace evenglow::core {

/// Numbers of batches on their way to the threads of a rank.
class BatchQueue {
 public:
  void push(std::size_t batch) {
    const std::lock_guard lock(mutex_);
    waiting_.push_back(batch);
    changed_.notify_one();
  }
  /// No more will come.
  void close() {
    const std::lock_guard lock(mutex_);
    closed_ = true;
    changed_.notify_all();
  }
  /// Waits for one; none: the queue is closed and empty.
  std::optional<std::size_t> pop() {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return closed_ || !waiting_.empty(); });
    if (waiting_.empty()) return std::nullopt;
    const std::size_t batch = waiting_.front();
    waiting_.pop_front();
    return batch;
  }
  /// Nobody wants those that wait.
  void clear() {
    const std::lock_guard lock(mutex_);
    waiting_.clear();
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return waiting_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<std::size_t> waiting_;
  bool closed_ = false;
};

}  // namespace evenglow::core
