#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <vector>

#include "core/parallel/rank_link.h"

namespace evenglow::core {

/// A checksum of numbers that all ranks must agree on (FNV-1a of their bits).
class Agreement {
 public:
  Agreement& add(std::uint64_t value);
  Agreement& add(const std::vector<double>& values);
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ULL;
};

/// The processes that share a run. All run the same program on the same input and come to the same decisions, each by
/// itself from the same bits; only the batches of traces are divided among them. Rank 0 hands out their numbers, a few
/// at a time, as ranks ask for them, so that a slow rank gets fewer; every rank is then given the results of all, which
/// it adds in the order of the batches. So the bits do not depend on who traced what.
///
/// At each meeting the ranks compare what they are at. A rank that fails or is stopped tells the others there, who end
/// as well; ranks that have come apart (other numbers, as of other processors' mathematics) end with an Error.
class RankGroup {
 public:
  using Work = std::function<void(std::size_t batch, const std::stop_token& stop)>;

  /// Alone if `link` is null.
  explicit RankGroup(std::unique_ptr<RankLink> link = nullptr);
  ~RankGroup();
  RankGroup(const RankGroup&) = delete;
  RankGroup& operator=(const RankGroup&) = delete;

  int rank() const { return link_ ? link_->rank() : 0; }
  int count() const { return link_ ? link_->count() : 1; }

  /// `work(i, stop)` for each i < count on one of the ranks, on at most `threads` of its threads. Which ones were made
  /// here, in rising order; empty: a stop was asked for, here or at another rank. An exception here is thrown on, one
  /// of another rank as Error with its number.
  std::optional<std::vector<std::size_t>> run_batches(std::size_t count, int threads, const Work& work,
                                                      const std::stop_token& stop, const Agreement& agreement);

  /// Fills in what others have: `results[i]` for each i of `own` is given to all. A stop is left to the next trace, and
  /// shortens the waiting for a lost rank alone. Throws Error if another rank has ended.
  void share(const std::vector<std::size_t>& own, std::vector<std::vector<double>>& results,
             const std::stop_token& stop);

  /// A text of each rank, in their order, at all ranks. Throws Error after a stop.
  std::vector<std::string> texts(const std::string& own, const std::stop_token& stop);

  /// CPU seconds that the other ranks have spent in `run_batches` up to now.
  double others_cpu_s() const { return others_cpu_s_; }

  /// The end of the run at this rank; `failure` tells the others why, if it failed. Returns when all have come to their
  /// end. Where a rank is lost, ends the process with the exit code.
  void finish(std::string_view failure, int exit_code);

 private:
  enum class Place : std::uint64_t { kTrace, kTraced, kShared, kText, kEnd };
  std::vector<std::string> gather(const std::string& bytes, const std::stop_token& stop);
  bool meet(Place place, std::uint64_t check, bool stopped, const std::string& failure, const std::stop_token& stop);
  std::optional<std::string> difference(const std::vector<std::string>& notes, Place place, std::uint64_t check) const;

  std::unique_ptr<RankLink> link_;
  bool over_ = false;  ///< another rank has ended, or come apart: there will be no further meeting
  bool lost_ = false;
  double others_cpu_s_ = 0.0, own_cpu_s_ = 0.0;
};

}  // namespace evenglow::core
