#include "design/dots/start_dots.h"

#include <algorithm>
#include <cmath>

#include "core/montecarlo/batches.h"
#include "core/montecarlo/photon_rng.h"
#include "design/dots/cell_corner.h"
#include "design/dots/dot_counts.h"

namespace evenglow::design {
namespace {

constexpr std::size_t kChunk = 16;
constexpr int kTriesPerDot = 200;

double largest_odds(const CoverageMap& map, const SizeLaw& law, double x0, double y0) {
  double most = 0.0;
  for (int j = 0; j <= 4; ++j) {
    for (int i = 0; i <= 4; ++i) {
      const double coverage = map.at(x0 + 0.25 * i * map.grid().dx, y0 + 0.25 * j * map.grid().dy);
      most = std::max(most, coverage / law.area(coverage));
    }
  }
  return most;
}

/// Sets up to `count` dots from `first` on; returns how many found a place.
std::size_t fill_cell(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law, std::size_t cell,
                      DotStore& store) {
  const core::CellGrid& g = map.grid();
  const auto [x0, y0] = cell_corner(g, cell);
  core::PhotonRng rng({spec.seed, 0, 1}, cell);
  const double most = largest_odds(map, law, x0, y0);
  auto& dots = store.dots();
  std::size_t at = store.begin(cell);
  const std::size_t tries = kTriesPerDot * (store.end(cell) - at);
  for (std::size_t i = 0; i < tries && at < store.end(cell); ++i) {
    const double x = x0 + rng.uniform() * g.dx, y = y0 + rng.uniform() * g.dy;
    const double coverage = map.at(x, y);
    if (rng.uniform() * most > coverage / law.area(coverage)) continue;
    const double diameter = law.diameter(coverage);
    const double half = 0.5 * core::footprint_span(spec.footprint, diameter);
    if (map.free().clearance(x, y, 2.0 * half) < half) continue;
    dots.x[at] = x;
    dots.y[at] = y;
    dots.diameter[at] = static_cast<float>(diameter);
    dots.spacing[at] = static_cast<float>(law.spacing(coverage));
    ++at;
  }
  return at - store.begin(cell);
}

}  // namespace

void for_each_cell(std::size_t cells, int threads, const std::function<void(std::size_t)>& work) {
  core::run_batches((cells + kChunk - 1) / kChunk, threads, [&](std::size_t chunk) {
    const std::size_t end = std::min(cells, (chunk + 1) * kChunk);
    for (std::size_t cell = chunk * kChunk; cell < end; ++cell) work(cell);
  });
}

core::CellField wanted_counts(const CoverageMap& map, const SizeLaw& law) {
  core::CellField wanted(map.grid(), 0.0);
  for (std::size_t i = 0; i < wanted.values.size(); ++i)
    wanted.values[i] = map.wanted(i) / law.area(map.coverage().values[i]);
  return wanted;
}

DotStore start_dots(const DotSpec& spec, const CoverageMap& map, const SizeLaw& law, int threads) {
  DotStore store(map.grid(), whole_counts(wanted_counts(map, law)));
  std::vector<char> empty(store.size(), 0);
  for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
    const std::size_t set = fill_cell(spec, map, law, cell, store);
    for (std::size_t i = store.begin(cell) + set; i < store.end(cell); ++i) empty[i] = 1;
    if (set == store.end(cell) - store.begin(cell)) store.sort(cell);
  });
  if (std::find(empty.begin(), empty.end(), 1) != empty.end()) store.remove(empty);
  return store;
}

}  // namespace evenglow::design
