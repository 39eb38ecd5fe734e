#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace evenglow::tracer {

/// Many discrete distributions over the same number of outcomes, each drawn from in constant time with one read of
/// memory (Walker 1977, in the linear-time form of Vose, IEEE Trans. Softw. Eng. 17, 1991). A slot packs a threshold of
/// 20 bits with an alias of 12, so that the odds of an outcome are off by 5e-7 / outcomes for each slot that leads to
/// it.
class AliasTables {
 public:
  static constexpr std::size_t kMaxOutcomes = 4096;

  /// `outcomes` in [1, kMaxOutcomes].
  explicit AliasTables(std::size_t outcomes);

  /// Adds a distribution with these weights (>= 0; size `outcomes`). All zero: every outcome alike.
  void add(std::span<const double> weights);

  /// Outcome of distribution `table` for a uniform number in (0, 1).
  std::size_t draw(std::size_t table, double uniform) const {
    const double scaled = uniform * static_cast<double>(outcomes_);
    const auto slot = static_cast<std::size_t>(scaled);
    const std::uint32_t packed = slots_[table * outcomes_ + slot];
    const double threshold = static_cast<double>(packed >> kAliasBits) * (1.0 / kOne);
    return scaled - static_cast<double>(slot) < threshold ? slot : packed & (kMaxOutcomes - 1);
  }

  std::size_t bytes() const { return slots_.size() * sizeof(std::uint32_t); }

 private:
  static constexpr unsigned kAliasBits = 12;
  static constexpr double kOne = (1u << 20) - 1;

  std::size_t outcomes_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace evenglow::tracer
