#include "core/parallel/hand_out.h"

#include <chrono>
#include <deque>
#include <mutex>
#include <numeric>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/base/error.h"
#include "tests/support/thread_ranks.h"

namespace evenglow::core {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::SizeIs;

using Words = std::vector<std::uint64_t>;
enum Word : std::uint64_t { kWant, kTake, kStop, kLeave };  // first words of messages, as in hand_out.cpp

/// One rank of two, whose partner is played by the test: it answers each message that is sent.
class PlayedLink : public RankLink {
 public:
  using Partner = std::function<std::vector<Words>(const Words&)>;
  PlayedLink(int rank, Partner partner) : rank_(rank), partner_(std::move(partner)) {}

  int rank() const override { return rank_; }
  int count() const override { return 2; }
  std::vector<std::string> all_gather(const std::string&, const std::stop_token&) override { return {}; }
  void send(int to, const Words& words) override {
    EXPECT_EQ(to, 1 - rank_);
    sent.push_back(words);
    for (Words& answer : partner_(words)) comes(std::move(answer));
  }
  std::optional<RankMessage> poll() override {
    if (mail_.empty()) return std::nullopt;
    RankMessage message = std::move(mail_.front());
    mail_.pop_front();
    return message;
  }
  void abandon(int) override {}

  void comes(Words words) { mail_.push_back({1 - rank_, std::move(words)}); }

  std::vector<Words> sent;

 private:
  int rank_;
  Partner partner_;
  std::deque<RankMessage> mail_;
};

void nothing(std::size_t, const std::stop_token&) {}

TEST(HandOut, EachBatchIsMadeOnceWhereItIsSaidToBe) {
  constexpr std::size_t kCount = 53;
  for (const int ranks : {1, 2, 3, 4}) {
    std::vector<HandedOut> outcomes(static_cast<std::size_t>(ranks));
    std::vector<std::vector<std::size_t>> worked(static_cast<std::size_t>(ranks));
    tests::on_ranks(ranks, [&](int rank, std::unique_ptr<RankLink> link) {
      const auto own = static_cast<std::size_t>(rank);
      std::mutex mutex;
      outcomes[own] = hand_out(*link, kCount, 2,
                               [&](std::size_t batch, const std::stop_token&) {
                                 std::this_thread::sleep_for(std::chrono::microseconds(500));
                                 const std::lock_guard lock(mutex);
                                 worked[own].push_back(batch);
                               },
                               {});
    });
    std::vector<std::size_t> all;
    for (std::size_t rank = 0; rank < outcomes.size(); ++rank) {
      const HandedOut& outcome = outcomes[rank];
      EXPECT_FALSE(outcome.stopped);
      EXPECT_EQ(outcome.failure, nullptr);
      EXPECT_TRUE(std::is_sorted(outcome.made.begin(), outcome.made.end()));
      EXPECT_THAT(outcome.made, testing::UnorderedElementsAreArray(worked[rank]));
      all.insert(all.end(), outcome.made.begin(), outcome.made.end());
    }
    std::sort(all.begin(), all.end());
    std::vector<std::size_t> expected(kCount);
    std::iota(expected.begin(), expected.end(), std::size_t{0});
    EXPECT_EQ(all, expected);
  }
}

/// A taker wants one batch more than it has threads, so that it has work while an answer is on its way; then it asks
/// for what it has room for, and leaves when none come.
TEST(HandOut, ATakerAsksForAsManyAsItHasThreadsAndOne) {
  std::deque<Words> answers = {{kTake, 7, 3, 5}, {kTake, 8}, {kTake}};
  PlayedLink link(1, [&](const Words& words) -> std::vector<Words> {
    if (words.at(0) != kWant) return {};
    Words answer = answers.front();
    answers.pop_front();
    return {answer};
  });
  const HandedOut outcome = hand_out(link, 100, 2, nothing, {});
  EXPECT_THAT(outcome.made, ElementsAre(3, 5, 7, 8));
  EXPECT_FALSE(outcome.stopped);
  ASSERT_THAT(link.sent, SizeIs(4));
  EXPECT_EQ(link.sent[0], (Words{kWant, 3}));
  for (const std::size_t i : {1U, 2U}) {
    EXPECT_EQ(link.sent[i][0], kWant);
    EXPECT_GE(link.sent[i][1], 1U);
    EXPECT_LE(link.sent[i][1], 3U);
  }
  EXPECT_EQ(link.sent[3], (Words{kLeave, 0}));
}

TEST(HandOut, ATakerThatIsStoppedByTheGiverLeavesAndSaysSo) {
  PlayedLink link(1, [](const Words& words) -> std::vector<Words> {
    if (words.at(0) != kWant) return {};
    return {{kTake, 4, 6}, {kStop}};
  });
  const HandedOut outcome = hand_out(link, 100, 1,
                                     [](std::size_t, const std::stop_token& stop) {
                                       while (!stop.stop_requested())
                                         std::this_thread::sleep_for(std::chrono::milliseconds(1));
                                     },
                                     {});
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.failure, nullptr);
  EXPECT_THAT(outcome.made, testing::Not(testing::Contains(6))) << "the second was not begun";
  EXPECT_EQ(link.sent.back(), (Words{kLeave, 1}));
}

TEST(HandOut, ATakerThatFailsLeavesForAStop) {
  PlayedLink link(1, [](const Words& words) -> std::vector<Words> {
    if (words.at(0) != kWant) return {};
    return {{kTake, 4}};
  });
  const HandedOut outcome =
      hand_out(link, 100, 1, [](std::size_t, const std::stop_token&) { throw Error("out of luck"); }, {});
  ASSERT_NE(outcome.failure, nullptr);
  EXPECT_THROW(std::rethrow_exception(outcome.failure), Error);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_THAT(outcome.made, IsEmpty());
  EXPECT_EQ(link.sent.back(), (Words{kLeave, 1}));
}

/// The partner wants 3, then more than there are; all numbers go out in their order, none twice, and at the end none.
TEST(HandOut, TheGiverGivesNoMoreThanIsAskedFor) {
  std::vector<std::size_t> given;
  PlayedLink link(0, [&](const Words& words) -> std::vector<Words> {
    if (words.at(0) != kTake) return {};
    given.insert(given.end(), words.begin() + 1, words.end());
    if (words.size() == 1) return {{kLeave, 0}};
    return {{kWant, 1'000'000}};
  });
  link.comes({kWant, 3});
  const HandedOut outcome = hand_out(link, 10'000, 1, nothing, {});
  ASSERT_GE(link.sent.size(), 3U);
  EXPECT_THAT(link.sent[0], SizeIs(4));
  for (const Words& words : link.sent) EXPECT_LE(words.size(), RankLink::kMostWords);
  EXPECT_THAT(link.sent[1], SizeIs(RankLink::kMostWords)) << "as many as a message holds";
  EXPECT_THAT(link.sent.back(), ElementsAre(kTake));
  EXPECT_TRUE(std::is_sorted(given.begin(), given.end()));
  given.insert(given.end(), outcome.made.begin(), outcome.made.end());
  std::sort(given.begin(), given.end());
  std::vector<std::size_t> expected(10'000);
  std::iota(expected.begin(), expected.end(), std::size_t{0});
  EXPECT_EQ(given, expected);
}

/// A failure here: the others are told once, and who asks afterwards gets none.
TEST(HandOut, AFailureOfTheGiverStopsTheOthers) {
  PlayedLink link(0, [&](const Words& words) -> std::vector<Words> {
    if (words.at(0) == kStop) return {{kWant, 3}};
    return {{kLeave, 1}};
  });
  const HandedOut outcome =
      hand_out(link, 100, 2, [](std::size_t, const std::stop_token&) { throw Error("out of luck"); }, {});
  EXPECT_NE(outcome.failure, nullptr);
  EXPECT_TRUE(outcome.stopped);
  EXPECT_THAT(link.sent, ElementsAre(Words{kStop}, Words{kTake}));
}

TEST(HandOut, AnotherThatLeavesForAStopStopsTheGiver) {
  PlayedLink link(0, [](const Words&) { return std::vector<Words>{}; });
  link.comes({kLeave, 1});
  const HandedOut outcome = hand_out(
      link, 1'000'000, 1,
      [](std::size_t, const std::stop_token&) { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }, {});
  EXPECT_TRUE(outcome.stopped);
  EXPECT_EQ(outcome.failure, nullptr);
  EXPECT_LT(outcome.made.size(), 1'000U);
}

/// Nobody answers after a stop: mpirun would kill this process a second after it asked for the end.
TEST(HandOut, TheGiverWaitsForNobodyLongAfterAStop) {
  PlayedLink link(0, [](const Words&) { return std::vector<Words>{}; });
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THROW(hand_out(link, 10, 1, nothing, stop.get_token()), RankLost);
}

}  // namespace
}  // namespace evenglow::core
