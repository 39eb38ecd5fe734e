#include "tests/support/thread_ranks.h"

#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>
#include <stdexcept>
#include <thread>
#include <utility>

namespace evenglow::tests {
namespace {

/// What the ranks have in common.
struct Hub {
  explicit Hub(int count) : parts(static_cast<std::size_t>(count)), mail(static_cast<std::size_t>(count)) {}

  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::string> parts;  ///< of the gathering at work
  std::size_t here = 0, round = 0;
  std::vector<std::string> whole;  ///< of the last gathering
  std::vector<std::deque<core::RankMessage>> mail;
};

class ThreadLink final : public core::RankLink {
 public:
  ThreadLink(std::shared_ptr<Hub> hub, int rank) : hub_(std::move(hub)), rank_(rank) {}

  int rank() const override { return rank_; }
  int count() const override { return static_cast<int>(hub_->mail.size()); }

  std::vector<std::string> all_gather(const std::string& mine, const std::stop_token& stop) override {
    std::unique_lock lock(hub_->mutex);
    const std::size_t round = hub_->round;
    hub_->parts[static_cast<std::size_t>(rank_)] = mine;
    if (++hub_->here == hub_->mail.size()) {
      hub_->whole = hub_->parts;
      hub_->here = 0;
      ++hub_->round;
      hub_->changed.notify_all();
      return hub_->whole;
    }
    for (int waited = 0; hub_->round == round; ++waited) {
      hub_->changed.wait_for(lock, std::chrono::milliseconds(10));
      if (stop.stop_requested() && waited > 100) throw core::RankLost("another rank does not answer");
    }
    return hub_->whole;  // the next gathering cannot end before all have left this one
  }

  void send(int to, const std::vector<std::uint64_t>& words) override {
    const std::lock_guard lock(hub_->mutex);
    hub_->mail[static_cast<std::size_t>(to)].push_back({rank_, words});
  }

  std::optional<core::RankMessage> poll() override {
    const std::lock_guard lock(hub_->mutex);
    auto& mail = hub_->mail[static_cast<std::size_t>(rank_)];
    if (mail.empty()) return std::nullopt;
    core::RankMessage message = std::move(mail.front());
    mail.pop_front();
    return message;
  }

  void abandon(int) override {}

 private:
  std::shared_ptr<Hub> hub_;
  int rank_;
};

}  // namespace

std::vector<std::unique_ptr<core::RankLink>> thread_links(int count) {
  const auto hub = std::make_shared<Hub>(count);
  std::vector<std::unique_ptr<core::RankLink>> links;
  for (int rank = 0; rank < count; ++rank) links.push_back(std::make_unique<ThreadLink>(hub, rank));
  return links;
}

void on_ranks(int count, const std::function<void(int, std::unique_ptr<core::RankLink>)>& body) {
  auto links = thread_links(count);
  std::vector<std::jthread> threads;
  for (int rank = 0; rank < count; ++rank) {
    threads.emplace_back([&body, rank, link = std::move(links[static_cast<std::size_t>(rank)])]() mutable {
      body(rank, std::move(link));
    });
  }
}

}  // namespace evenglow::tests
