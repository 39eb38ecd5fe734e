#include "core/parallel/ranks.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "core/parallel/hand_out.h"

namespace evenglow::core {
namespace {

/// What a rank says when it meets the others; the text of a failure follows.
struct Note {
  std::uint64_t place = 0, check = 0, stopped = 0;
  double cpu_s = 0.0;  ///< spent by it in traces so far
};

std::string packed(const Note& note, const std::string& failure) {
  std::string bytes(sizeof(Note), '\0');
  std::memcpy(bytes.data(), &note, sizeof(Note));
  return bytes + failure;
}

Note note_of(const std::string& bytes) {
  expects(bytes.size() >= sizeof(Note), "a rank sends a whole note");
  Note note;
  std::memcpy(&note, bytes.data(), sizeof(Note));
  return note;
}

template <typename Number>
void append(std::string& bytes, const Number* numbers, std::size_t count) {
  if (count > 0) bytes.append(reinterpret_cast<const char*>(numbers), count * sizeof(Number));
}

std::string packed(const std::vector<std::size_t>& own, const std::vector<std::vector<double>>& results) {
  std::string bytes;
  for (const std::size_t i : own) {
    const std::uint64_t head[2] = {i, results[i].size()};
    append(bytes, head, 2);
    append(bytes, results[i].data(), results[i].size());
  }
  return bytes;
}

void unpack(const std::string& bytes, std::vector<std::vector<double>>& results) {
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t head[2];
    expects(bytes.size() - at >= sizeof(head), "results of a rank are whole");
    std::memcpy(head, bytes.data() + at, sizeof(head));
    at += sizeof(head);
    expects(head[0] < results.size() && head[1] <= (bytes.size() - at) / sizeof(double), "results of a rank are whole");
    std::vector<double>& result = results[head[0]];
    result.resize(head[1]);
    if (!result.empty()) std::memcpy(result.data(), bytes.data() + at, head[1] * sizeof(double));
    at += head[1] * sizeof(double);
  }
}

std::vector<std::size_t> all_of(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  for (std::size_t i = 0; i < count; ++i) numbers[i] = i;
  return numbers;
}

std::string what_of(const std::exception_ptr& failure) {
  try {
    std::rethrow_exception(failure);
  } catch (const std::exception& error) {
    return error.what();
  } catch (...) {
    return "it failed";
  }
}

}  // namespace

Agreement& Agreement::add(std::uint64_t value) {
  for (int byte = 0; byte < 8; ++byte) hash_ = (hash_ ^ ((value >> (8 * byte)) & 0xFFU)) * 1099511628211ULL;
  return *this;
}

Agreement& Agreement::add(const std::vector<double>& values) {
  for (const double value : values) add(std::bit_cast<std::uint64_t>(value));
  return *this;
}

RankGroup::RankGroup(std::unique_ptr<RankLink> link) : link_(std::move(link)) {}
RankGroup::~RankGroup() = default;

std::optional<std::vector<std::size_t>> RankGroup::run_batches(std::size_t count, int threads, const Work& work,
                                                               const std::stop_token& stop,
                                                               const Agreement& agreement) {
  if (RankGroup::count() == 1) {
    const bool whole = core::run_batches(
        count, threads, [&](std::size_t batch) { work(batch, stop); }, stop);
    if (!whole || stop.stop_requested()) return std::nullopt;
    return all_of(count);
  }
  if (!meet(Place::kTrace, agreement.value(), stop.stop_requested(), "", stop)) return std::nullopt;
  const double cpu = process_cpu_seconds();
  HandedOut outcome;
  try {
    outcome = hand_out(*link_, count, threads, work, stop);
  } catch (const RankLost&) {
    over_ = lost_ = true;
    throw;
  }
  own_cpu_s_ += process_cpu_seconds() - cpu;
  const std::string failure = outcome.failure ? what_of(outcome.failure) : "";
  try {
    if (!meet(Place::kTraced, 0, outcome.stopped, failure, stop)) return std::nullopt;
  } catch (const RankLost&) {
    throw;
  } catch (const Error&) {
    if (outcome.failure) std::rethrow_exception(outcome.failure);
    throw;
  }
  return std::move(outcome.made);
}

void RankGroup::share(const std::vector<std::size_t>& own, std::vector<std::vector<double>>& results,
                      const std::stop_token& stop) {
  if (count() == 1) return;
  if (!meet(Place::kShared, results.size(), false, "", stop)) throw Error("another rank has ended");
  const std::vector<std::string> all = gather(packed(own, results), stop);
  for (int i = 0; i < count(); ++i) {
    if (i != rank()) unpack(all[static_cast<std::size_t>(i)], results);
  }
}

std::vector<std::string> RankGroup::texts(const std::string& own, const std::stop_token& stop) {
  if (count() == 1) return {own};
  if (!meet(Place::kText, 0, stop.stop_requested(), "", stop)) throw Error("interrupted before the first step");
  return gather(own, stop);
}

std::vector<std::string> RankGroup::gather(const std::string& bytes, const std::stop_token& stop) {
  try {
    return link_->all_gather(bytes, stop);
  } catch (const RankLost&) {
    over_ = lost_ = true;
    throw;
  }
}

bool RankGroup::meet(Place place, std::uint64_t check, bool stopped, const std::string& failure,
                     const std::stop_token& stop) {
  if (over_) return false;
  const Note own{static_cast<std::uint64_t>(place), check, stopped ? 1ULL : 0ULL, own_cpu_s_};
  const std::vector<std::string> notes = gather(packed(own, failure), stop);
  bool any_stopped = false, any_ended = false;
  others_cpu_s_ = -own_cpu_s_;
  for (const std::string& bytes : notes) {
    const Note note = note_of(bytes);
    any_stopped = any_stopped || note.stopped != 0;
    any_ended = any_ended || note.place == static_cast<std::uint64_t>(Place::kEnd);
    others_cpu_s_ += note.cpu_s;
  }
  if (any_ended) over_ = true;
  for (std::size_t i = 0; i < notes.size(); ++i) {
    if (notes[i].size() == sizeof(Note) || static_cast<int>(i) == rank()) continue;
    over_ = true;
    throw Error("rank " + std::to_string(i) + ": " + notes[i].substr(sizeof(Note)));
  }
  if (!failure.empty()) {
    over_ = true;
    throw Error(failure);
  }
  if (any_stopped || any_ended) return false;
  if (const auto told = difference(notes, place, check)) {
    over_ = true;
    throw Error(*told);
  }
  return true;
}

std::optional<std::string> RankGroup::difference(const std::vector<std::string>& notes, Place place,
                                                 std::uint64_t check) const {
  for (std::size_t i = 0; i < notes.size(); ++i) {
    const Note note = note_of(notes[i]);
    if (note.place == static_cast<std::uint64_t>(place) && note.check == check) continue;
    return "rank " + std::to_string(i) + " has come to other numbers than rank " + std::to_string(rank()) +
           ": all ranks must run one binary, on processors of one kind";
  }
  return std::nullopt;
}

void RankGroup::finish(std::string_view failure, int exit_code) {
  if (count() == 1) return;
  if (lost_) {
    link_->abandon(exit_code);
    return;
  }
  if (over_) return;
  try {
    meet(Place::kEnd, 0, exit_code != 0, std::string(failure), {});
  } catch (const RankLost&) {
    link_->abandon(exit_code);
  } catch (const Error&) {
    // Each rank tells its own failure.
  }
}

}  // namespace evenglow::core
