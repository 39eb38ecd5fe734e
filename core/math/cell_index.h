#pragma once

#include <cstddef>

namespace evenglow::core {

/// Place of cell (ix, iy), both from 0, among the values of a grid with `nx` cells along x. In whole words, so that no
/// product of two `int`s can overflow on its way.
constexpr std::size_t cell_index(int nx, int ix, int iy) {
  return static_cast<std::size_t>(iy) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(ix);
}

}  // namespace evenglow::core
