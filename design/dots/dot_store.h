#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/math/cell_field.h"

namespace evenglow::design {

/// Dots sorted by the cell of the density that they belong to, and within each cell by small bins, so that the dots
/// near a point are found in a few runs of memory. Both orders are made anew after moves.
class DotStore {
 public:
  struct Dots {
    std::vector<double> x, y;     ///< mm
    std::vector<float> spacing;   ///< mm, of the place
    std::vector<float> diameter;  ///< mm
  };

  /// `counts[cell]` dots in each cell, all to be set by the caller.
  DotStore(const core::CellGrid& cells, const std::vector<int>& counts);

  const core::CellGrid& grid() const { return grid_; }
  std::size_t size() const { return dots_.x.size(); }
  std::size_t cell_count() const { return first_.size() - 1; }
  std::size_t begin(std::size_t cell) const { return first_[cell]; }
  std::size_t end(std::size_t cell) const { return first_[cell + 1]; }
  Dots& dots() { return dots_; }
  const Dots& dots() const { return dots_; }

  /// Sorts a cell's dots into its bins (stable). Different cells may be sorted at the same time.
  void sort(std::size_t cell);
  /// Sorts all dots into the cells they are in and these into their bins (stable).
  void sort_all(int threads);
  /// Takes away the marked dots; `marked` has one entry a dot.
  void remove(const std::vector<char>& marked);

  /// Calls `visit(index)` for all dots of the bins that the square of half width `reach` around (x, y) touches, in the
  /// order of cells, bins and dots.
  template <typename Visit>
  void near(double x, double y, double reach, Visit&& visit) const;

 private:
  struct Bins {
    int nx = 1, ny = 1;
    std::size_t first = 0;  ///< in bin_begin_
  };

  void make_bins();
  void reorder(const std::vector<std::uint32_t>& order);

  core::CellGrid grid_;
  Dots dots_;
  std::vector<std::size_t> first_;        ///< of each cell, and the end
  std::vector<Bins> bins_;                ///< of each cell
  std::vector<std::uint32_t> bin_begin_;  ///< index of a bin's first dot within its cell; nx ny + 1 a cell
};

template <typename Visit>
void DotStore::near(double x, double y, double reach, Visit&& visit) const {
  const auto column = [&](double at) { return static_cast<int>(std::clamp(at, 0.0, grid_.nx - 1.0)); };
  const auto row = [&](double at) { return static_cast<int>(std::clamp(at, 0.0, grid_.ny - 1.0)); };
  const double u0 = (x - reach - grid_.x0) / grid_.dx, u1 = (x + reach - grid_.x0) / grid_.dx;
  const double v0 = (y - reach - grid_.y0) / grid_.dy, v1 = (y + reach - grid_.y0) / grid_.dy;
  for (int iy = row(v0); iy <= row(v1); ++iy) {
    for (int ix = column(u0); ix <= column(u1); ++ix) {
      const auto cell =
          static_cast<std::size_t>(iy) * static_cast<std::size_t>(grid_.nx) + static_cast<std::size_t>(ix);
      const Bins& bins = bins_[cell];
      const auto bin = [](double at, int count) {
        return static_cast<std::size_t>(std::clamp(at * count, 0.0, count - 1.0));
      };
      const std::size_t bx0 = bin(u0 - ix, bins.nx), bx1 = bin(u1 - ix, bins.nx);
      const std::size_t by0 = bin(v0 - iy, bins.ny), by1 = bin(v1 - iy, bins.ny);
      const std::uint32_t* begins = bin_begin_.data() + bins.first;
      for (std::size_t by = by0; by <= by1; ++by) {
        const std::size_t start = by * static_cast<std::size_t>(bins.nx);
        const std::size_t last = first_[cell] + begins[start + bx1 + 1];
        for (std::size_t i = first_[cell] + begins[start + bx0]; i < last; ++i) visit(i);
      }
    }
  }
}

}  // namespace evenglow::design
