#include "design/dots/dot_store.h"

#include <cmath>
#include <numeric>

#include "core/montecarlo/batches.h"
#include "design/dots/cell_corner.h"

namespace evenglow::design {
namespace {

constexpr double kDotsPerBin = 2.0;
constexpr std::size_t kChunk = 4096;  // dots
constexpr std::size_t kCells = 16;

template <typename T>
void permute(std::vector<T>& values, std::size_t begin, const std::vector<std::uint32_t>& order, std::vector<T>& room) {
  room.resize(order.size());
  for (std::size_t i = 0; i < order.size(); ++i) room[i] = values[begin + order[i]];
  std::copy(room.begin(), room.end(), values.begin() + static_cast<std::ptrdiff_t>(begin));
}

template <typename T>
void keep_unmarked(std::vector<T>& values, const std::vector<char>& marked) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (marked[i] == 0) values[kept++] = values[i];
  }
  values.resize(kept);
}

}  // namespace

DotStore::DotStore(const core::CellGrid& cells, const std::vector<int>& counts)
    : grid_(cells), first_(counts.size() + 1, 0) {
  for (std::size_t i = 0; i < counts.size(); ++i) first_[i + 1] = first_[i] + static_cast<std::size_t>(counts[i]);
  const std::size_t all = first_.back();
  dots_.x.assign(all, 0.0);
  dots_.y.assign(all, 0.0);
  dots_.spacing.assign(all, 0.0f);
  dots_.diameter.assign(all, 0.0f);
  make_bins();
}

void DotStore::make_bins() {
  bins_.assign(cell_count(), {});
  std::size_t used = 0;
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    const double count = std::max(1.0, static_cast<double>(end(cell) - begin(cell)) / kDotsPerBin);
    const double size = std::sqrt(grid_.cell_area() / count);
    Bins& bins = bins_[cell];
    bins.nx = std::max(1, static_cast<int>(grid_.dx / size));
    bins.ny = std::max(1, static_cast<int>(grid_.dy / size));
    bins.first = used;
    used += static_cast<std::size_t>(bins.nx) * static_cast<std::size_t>(bins.ny) + 1;
  }
  bin_begin_.assign(used, 0);
}

void DotStore::sort(std::size_t cell) {
  const Bins& bins = bins_[cell];
  const std::size_t from = begin(cell), count = end(cell) - from;
  const auto bin_count = static_cast<std::size_t>(bins.nx) * static_cast<std::size_t>(bins.ny);
  const auto [x0, y0] = cell_corner(grid_, cell);
  std::vector<std::uint32_t> bin_of(count), order(count);
  std::uint32_t* begins = bin_begin_.data() + bins.first;
  std::fill(begins, begins + bin_count + 1, 0u);
  for (std::size_t i = 0; i < count; ++i) {
    const double u = std::clamp((dots_.x[from + i] - x0) / grid_.dx * bins.nx, 0.0, bins.nx - 1.0);
    const double v = std::clamp((dots_.y[from + i] - y0) / grid_.dy * bins.ny, 0.0, bins.ny - 1.0);
    bin_of[i] = static_cast<std::uint32_t>(v) * static_cast<std::uint32_t>(bins.nx) + static_cast<std::uint32_t>(u);
    ++begins[bin_of[i] + 1];
  }
  std::partial_sum(begins, begins + bin_count + 1, begins);
  std::vector<std::uint32_t> next(begins, begins + bin_count);
  for (std::size_t i = 0; i < count; ++i) order[next[bin_of[i]]++] = static_cast<std::uint32_t>(i);
  std::vector<double> wide;
  std::vector<float> narrow;
  permute(dots_.x, from, order, wide);
  permute(dots_.y, from, order, wide);
  permute(dots_.spacing, from, order, narrow);
  permute(dots_.diameter, from, order, narrow);
}

void DotStore::reorder(const std::vector<std::uint32_t>& order) {
  std::vector<double> wide;
  std::vector<float> narrow;
  permute(dots_.x, 0, order, wide);
  permute(dots_.y, 0, order, wide);
  permute(dots_.spacing, 0, order, narrow);
  permute(dots_.diameter, 0, order, narrow);
}

void DotStore::sort_all(int threads) {
  std::vector<std::uint32_t> cell_of(size()), order(size());
  core::run_batches((size() + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t last = std::min(size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < last; ++i)
      cell_of[i] = static_cast<std::uint32_t>(grid_.nearest_index(dots_.x[i], dots_.y[i]));
  });
  std::fill(first_.begin(), first_.end(), std::size_t{0});
  for (const std::uint32_t cell : cell_of) ++first_[cell + 1];
  std::partial_sum(first_.begin(), first_.end(), first_.begin());
  std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
  for (std::size_t i = 0; i < size(); ++i) order[next[cell_of[i]]++] = static_cast<std::uint32_t>(i);
  reorder(order);
  make_bins();
  core::run_batches((cell_count() + kCells - 1) / kCells, threads, [&](std::size_t chunk) {
    const std::size_t last = std::min(cell_count(), (chunk + 1) * kCells);
    for (std::size_t cell = chunk * kCells; cell < last; ++cell) sort(cell);
  });
}

void DotStore::remove(const std::vector<char>& marked) {
  std::vector<std::size_t> first(first_.size(), 0);
  for (std::size_t cell = 0; cell < cell_count(); ++cell) {
    std::size_t kept = 0;
    for (std::size_t i = begin(cell); i < end(cell); ++i) kept += marked[i] == 0;
    first[cell + 1] = first[cell] + kept;
  }
  keep_unmarked(dots_.x, marked);
  keep_unmarked(dots_.y, marked);
  keep_unmarked(dots_.spacing, marked);
  keep_unmarked(dots_.diameter, marked);
  first_ = std::move(first);
  make_bins();
  for (std::size_t cell = 0; cell < cell_count(); ++cell) sort(cell);
}

}  // namespace evenglow::design
