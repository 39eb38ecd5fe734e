#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

namespace evenglow::tracer {

/// Proposals for rejection sampling: many discrete distributions over kRows x kColumns blocks, each drawn from by
/// inversion with two reads of one short run of memory (row, then block in the row) and no search. The odds of a block
/// are whole numbers over a common total, rounded up from what was asked for, so that a proposal never falls short of
/// the bound that it was made from.
class LobeProposals {
 public:
  static constexpr std::size_t kRows = 20;
  static constexpr std::size_t kColumns = 16;
  static constexpr std::size_t kBlocks = kRows * kColumns;

  /// Adds a distribution with at least these weights (>= 0; row-major). All zero: it must not be drawn from.
  void add(std::span<const double> weights);

  struct Block {
    std::size_t row = 0, column = 0;
    double weight = 0.0;  ///< that its odds stand for: weight / total(), never below what was asked for
  };
  /// Block of distribution `table` for a uniform number in [0, 1).
  Block draw(std::size_t table, double uniform) const {
    const Table& t = tables_[table];
    const auto at = static_cast<std::int16_t>(static_cast<int>(uniform * t.counts) - kBias);
    const std::size_t row = last_not_above<kPaddedRows>(t.rows.data(), at);
    const std::int16_t* const blocks = t.blocks.data() + row * kColumns;
    const std::size_t column = last_not_above<kColumns>(blocks, at);
    const int next = column + 1 < kColumns ? blocks[column + 1] : t.rows[row + 1];
    return {row, column, t.unit * (next - blocks[column])};
  }

  /// Tells the processor that `draw` of this distribution will follow.
  void prefetch(std::size_t table) const { __builtin_prefetch(&tables_[table]); }

  /// Sum of the weights that the odds stand for.
  double total(std::size_t table) const { return tables_[table].unit * tables_[table].counts; }

  std::size_t bytes() const { return tables_.size() * sizeof(Table); }

 private:
  /// Counts run from 0 to kMost; stored less kBias, as 16-bit comparisons are signed.
  static constexpr int kBias = 32768;
  static constexpr int kMost = 65535;

  static constexpr std::size_t kPaddedRows = 24;  ///< whole vectors of eight

  struct alignas(64) Table {
    double unit = 0.0;                             ///< weight of a count
    double counts = 0.0;                           ///< in all
    std::array<std::int16_t, kPaddedRows> rows{};  ///< sum of the counts before the row; from kRows on: of all
    std::array<std::int16_t, kBlocks> blocks{};    ///< sum of the counts before the block
  };

  /// Eight numbers that one instruction compares.
  using Lanes = std::int16_t __attribute__((vector_size(16)));

  /// The number of entries <= value, less one, by comparing all: shorter than a search, without a branch to guess.
  template <std::size_t kCount>
  static std::size_t last_not_above(const std::int16_t* first, std::int16_t value) {
    static_assert(kCount % 8 == 0);
    Lanes counts{};
    for (std::size_t i = 0; i < kCount; i += 8) {
      Lanes lanes;
      std::memcpy(&lanes, first + i, sizeof lanes);
      counts -= lanes <= value;  // true is -1
    }
    // The sum of the lanes, each below 16: those of both halves, then by one multiplication.
    std::array<std::uint64_t, 2> halves;
    std::memcpy(halves.data(), &counts, sizeof counts);
    return ((halves[0] + halves[1]) * 0x0001000100010001u >> 48) - 1;
  }

  std::vector<Table> tables_;
};

}  // namespace evenglow::tracer
