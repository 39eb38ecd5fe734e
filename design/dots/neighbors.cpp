#include "design/dots/neighbors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "design/dots/start_dots.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kAround = 7;
constexpr double kFar = std::numeric_limits<double>::infinity();

struct Sums {
  double least = kFar, gap = kFar, distance = 0.0, relative = 0.0, relative2 = 0.0;
  std::size_t overlaps = 0, judged = 0;
};

/// The nearest distances of a dot, ascending, and the least gap.
struct Around {
  std::array<double, kAround> distance{};
  double gap = kFar;
};

Around look_around(const DotStore& store, core::Footprint footprint, std::size_t i, double reach) {
  Around around;
  around.distance.fill(kFar);
  const auto& dots = store.dots();
  const double own = core::footprint_span(footprint, static_cast<double>(dots.diameter[i]));
  store.near(dots.x[i], dots.y[i], reach, [&](std::size_t j) {
    if (j == i) return;
    const double r = std::hypot(dots.x[i] - dots.x[j], dots.y[i] - dots.y[j]);
    const double other = core::footprint_span(footprint, static_cast<double>(dots.diameter[j]));
    around.gap = std::min(around.gap, r - 0.5 * (own + other));
    if (r >= around.distance.back()) return;
    around.distance.back() = r;
    for (std::size_t k = kAround - 1; k > 0 && around.distance[k] < around.distance[k - 1]; --k)
      std::swap(around.distance[k], around.distance[k - 1]);
  });
  return around;
}

void add_dot(const DotStore& store, core::Footprint footprint, std::size_t i, double most, Sums& sums) {
  double reach = 2.0 * static_cast<double>(store.dots().spacing[i]);
  Around around = look_around(store, footprint, i, reach);
  while (around.distance.back() > reach && reach < most) {
    reach *= 1.6;
    around = look_around(store, footprint, i, reach);
  }
  sums.least = std::min(sums.least, around.distance[0]);
  sums.gap = std::min(sums.gap, around.gap);
  sums.overlaps += around.gap < 0.0;
  sums.distance += around.distance[0];
  if (around.distance.back() == kFar) return;
  // The circle through the 7th neighbor holds 7 dots within it and half of the last one: density 7 / (pi r^2), unbiased
  // for a random pattern if the dot itself is not counted.
  const double area = std::numbers::pi * std::pow(around.distance.back(), 2) / static_cast<double>(kAround);
  const double relative = around.distance[0] / std::sqrt(area * 2.0 / std::sqrt(3.0));
  sums.relative += relative;
  sums.relative2 += relative * relative;
  ++sums.judged;
}

}  // namespace

NeighborStatistics neighbor_statistics(const DotStore& store, core::Footprint footprint, int threads) {
  const core::CellGrid& g = store.grid();
  const double most = std::hypot(g.nx * g.dx, g.ny * g.dy);
  std::vector<Sums> parts(store.cell_count());
  for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) add_dot(store, footprint, i, most, parts[cell]);
  });
  Sums sums;
  for (const Sums& part : parts) {
    sums.least = std::min(sums.least, part.least);
    sums.gap = std::min(sums.gap, part.gap);
    sums.distance += part.distance;
    sums.relative += part.relative;
    sums.relative2 += part.relative2;
    sums.overlaps += part.overlaps;
    sums.judged += part.judged;
  }
  NeighborStatistics result;
  result.least_distance = sums.least;
  result.least_gap = sums.gap;
  result.overlaps = sums.overlaps;
  result.mean_distance = sums.distance / static_cast<double>(store.size());
  if (sums.judged > 0) {
    const auto n = static_cast<double>(sums.judged);
    result.mean_relative = sums.relative / n;
    result.sd_relative = std::sqrt(std::max(0.0, sums.relative2 / n - result.mean_relative * result.mean_relative));
  }
  return result;
}

}  // namespace evenglow::design
