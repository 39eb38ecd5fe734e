#pragma once

#include <bit>
#include <cstdint>

namespace evenglow::core {

/// `condition ? yes : no` without a branch: for conditions that are as random as the photons, where a wrong guess of
/// the processor costs more than computing both.
inline double select(bool condition, double yes, double no) {
  const std::uint64_t mask = -static_cast<std::uint64_t>(condition);
  return std::bit_cast<double>((std::bit_cast<std::uint64_t>(yes) & mask) | (std::bit_cast<std::uint64_t>(no) & ~mask));
}

}  // namespace evenglow::core
