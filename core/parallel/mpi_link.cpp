#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <limits>
#include <thread>

#include <mpi.h>

#include "core/base/error.h"
#include "core/parallel/launcher.h"
#include "core/parallel/rank_link.h"

/// The one door to MPI.
namespace evenglow::core {
namespace {

using Clock = std::chrono::steady_clock;
constexpr int kTag = 17;
constexpr std::chrono::milliseconds kPatience{20000};
constexpr std::chrono::milliseconds kPatienceOfFirst{600};  // mpirun waits 1 s between asking to end and killing

void check(int code, const char* what) {
  if (code == MPI_SUCCESS) return;
  std::array<char, MPI_MAX_ERROR_STRING> text{};
  int length = 0;
  MPI_Error_string(code, text.data(), &length);
  throw Error(std::string("MPI: ") + what + ": " + std::string(text.data(), static_cast<std::size_t>(length)));
}

/// MPI waits by spinning; threads that trace need the core more.
void wait_for(MPI_Request& request, const std::stop_token& stop, std::chrono::milliseconds patience) {
  std::optional<Clock::time_point> asked;
  const auto begin = Clock::now();
  for (int done = 0;;) {
    check(MPI_Test(&request, &done, MPI_STATUS_IGNORE), "a message");
    if (done != 0) return;
    const auto now = Clock::now();
    if (stop.stop_requested() && !asked) asked = now;
    if (asked && now - *asked > patience) throw RankLost("another rank has ended or does not answer: --resume goes on from the last whole step");
    if (now - begin < std::chrono::milliseconds(2)) {
      std::this_thread::yield();
    } else {
      std::this_thread::sleep_for(std::chrono::microseconds(100));
    }
  }
}

class MpiLink final : public RankLink {
 public:
  MpiLink() {
    int provided = 0;
    check(MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SERIALIZED, &provided), "the start");
    MPI_Comm_set_errhandler(MPI_COMM_WORLD, MPI_ERRORS_RETURN);
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &count_);
    if (provided < MPI_THREAD_SERIALIZED) throw Error("MPI: this installation cannot be called from threads");
  }
  ~MpiLink() override { MPI_Finalize(); }

  int rank() const override { return rank_; }
  int count() const override { return count_; }

  std::vector<std::string> all_gather(const std::string& mine, const std::stop_token& stop) override {
    const auto ranks = static_cast<std::size_t>(count_);
    std::vector<std::uint64_t> sizes(ranks);
    const std::uint64_t size = mine.size();
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Iallgather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, MPI_COMM_WORLD, &request), "sizes");
    wait_for(request, stop, patience());
    std::vector<std::string> all(ranks);
    // MPI counts in int: long texts go in rounds.
    const std::uint64_t round = static_cast<std::uint64_t>(std::numeric_limits<int>::max()) / ranks;
    const std::uint64_t longest = *std::max_element(sizes.begin(), sizes.end());
    for (std::uint64_t from = 0; from < longest; from += round) gather_round(mine, from, round, sizes, all, stop);
    return all;
  }

  void send(int to, const std::vector<std::uint64_t>& words) override {
    expects(words.size() <= kMostWords, "messages between ranks are short");
    // Short messages are copied and sent at once, whether they are awaited or not.
    check(MPI_Send(words.data(), static_cast<int>(words.size()), MPI_UINT64_T, to, kTag, MPI_COMM_WORLD), "a message");
  }

  std::optional<RankMessage> poll() override {
    int there = 0;
    MPI_Status status;
    check(MPI_Iprobe(MPI_ANY_SOURCE, kTag, MPI_COMM_WORLD, &there, &status), "a message");
    if (there == 0) return std::nullopt;
    int words = 0;
    MPI_Get_count(&status, MPI_UINT64_T, &words);
    RankMessage message{status.MPI_SOURCE, std::vector<std::uint64_t>(static_cast<std::size_t>(words))};
    check(MPI_Recv(message.words.data(), words, MPI_UINT64_T, message.from, kTag, MPI_COMM_WORLD, MPI_STATUS_IGNORE),
          "a message");
    return message;
  }

  /// The launcher is ending all ranks already, as a stop was asked for: MPI_Abort would only say so again, at length.
  void abandon(int exit_code) override { std::_Exit(exit_code); }

 private:
  void gather_round(const std::string& mine, std::uint64_t from, std::uint64_t round,
                    const std::vector<std::uint64_t>& sizes, std::vector<std::string>& all,
                    const std::stop_token& stop) const {
    std::vector<int> counts(sizes.size()), places(sizes.size());
    int sum = 0;
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      counts[i] = static_cast<int>(sizes[i] > from ? std::min(round, sizes[i] - from) : 0);
      places[i] = sum;
      sum += counts[i];
    }
    std::string got(static_cast<std::size_t>(sum), '\0');
    const char* own = mine.data() + std::min<std::uint64_t>(from, mine.size());
    MPI_Request request = MPI_REQUEST_NULL;
    check(MPI_Iallgatherv(own, counts[static_cast<std::size_t>(rank_)], MPI_BYTE, got.data(), counts.data(),
                          places.data(), MPI_BYTE, MPI_COMM_WORLD, &request),
          "results");
    wait_for(request, stop, patience());
    for (std::size_t i = 0; i < sizes.size(); ++i) {
      all[i].append(got, static_cast<std::size_t>(places[i]), static_cast<std::size_t>(counts[i]));
    }
  }

  std::chrono::milliseconds patience() const { return rank_ == 0 ? kPatienceOfFirst : kPatience; }

  int rank_ = 0, count_ = 1;
};

}  // namespace

std::unique_ptr<RankLink> world_link() {
  if (!started_by_launcher()) return nullptr;
  return std::make_unique<MpiLink>();
}

}  // namespace evenglow::core
