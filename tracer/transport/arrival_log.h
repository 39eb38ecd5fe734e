#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

namespace evenglow::tracer {

/// What happened to photons as far as the density of the pattern has a say in it: one word of 32 bits an event, two for
/// a deposit. The upper three bits of a word are its kind, the others a cell of the density or of the display.
enum class LogKind : std::uint32_t {
  kPassed,   ///< an arrival at this cell of the pattern that met the bare face
  kMet,      ///< an arrival that met the microstructure
  kCrossed,  ///< the next deposit alone goes through the bare face of this cell
  kShare,    ///< the `kShared` deposits to come are in proportion to the density of this cell
  kDeposit,  ///< light for this cell of the display: its amount follows, as a float
  kShared,   ///< the same in proportion to the density of the last `kShare`
  kPhotonEnd
};

/// The events of a batch of photons, in their order, up to so many bytes.
class alignas(128) ArrivalLog {  // apart from those of other threads
 public:
  static constexpr std::uint32_t kKindShift = 29;
  static constexpr std::uint32_t kMostIndex = (1U << kKindShift) - 1;
  static constexpr std::uint32_t word(LogKind kind, std::size_t index) {
    return (static_cast<std::uint32_t>(kind) << kKindShift) | static_cast<std::uint32_t>(index);
  }
  static constexpr LogKind kind(std::uint32_t word) { return static_cast<LogKind>(word >> kKindShift); }

  ArrivalLog() = default;
  explicit ArrivalLog(std::size_t bytes) : most_words_(bytes / sizeof(std::uint32_t)) {}

  /// Is there room for another photon? The last one may pass the limit: were it dropped, long histories would be
  /// missing (E[sum] = E[number] x mean holds for a number that only the photons up to it decide: Wald 1944).
  bool has_room() const { return words_.size() < most_words_; }

  /// Before the first event: memory for all to come, of which only what is written to is taken from the system.
  void reserve() { words_.reserve(most_words_ + kLongHistory); }
  bool empty() const { return words_.empty(); }
  void end_photon() {
    words_.push_back(word(LogKind::kPhotonEnd, 0));
    ++photons_;
    shared_ = false;
  }
  void arrival(std::size_t cell, bool met) { words_.push_back(word(met ? LogKind::kMet : LogKind::kPassed, cell)); }
  void crossing(std::size_t cell) { words_.push_back(word(LogKind::kCrossed, cell)); }
  /// Deposits up to `end_share` are in proportion to the density of the cell.
  void begin_share(std::size_t cell) {
    words_.push_back(word(LogKind::kShare, cell));
    shared_ = true;
  }
  void end_share() { shared_ = false; }
  void deposit(std::size_t bin, double amount) {
    words_.push_back(word(shared_ ? LogKind::kShared : LogKind::kDeposit, bin));
    words_.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(amount)));
  }
  std::size_t photons() const { return photons_; }
  std::vector<std::uint32_t> take() { return std::move(words_); }

 private:
  static constexpr std::size_t kLongHistory = 20000;  // words
  std::vector<std::uint32_t> words_;
  std::size_t most_words_ = 0, photons_ = 0;
  bool shared_ = false;
};

}  // namespace evenglow::tracer
