#include "design/dots/placement.h"

#include <algorithm>
#include <cmath>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "design/dots/cell_corner.h"
#include "design/dots/exact_sizes.h"
#include "design/dots/lattice.h"
#include "design/dots/relaxation.h"
#include "design/dots/size_law.h"
#include "design/dots/start_dots.h"

namespace evenglow::design {
namespace {

constexpr double kMostDots = 5e7;
constexpr int kSeparationSteps = 400;
constexpr double kPerNm = 1e6;  // nm in a mm

[[noreturn]] void refuse(const std::string& key, const std::string& message) {
  throw core::ConfigError(core::Fault{"dots", 0, 0, key, message});
}

/// The map with every cell brought down to what the limits allow; notes how many there were.
CoverageMap possible_map(const DotSpec& spec, const CoverageMap& map, std::size_t& short_cells) {
  const SizeLaw law(spec, map);
  core::CellField coverage = map.coverage();
  std::size_t worst = 0;
  double worst_excess = 0.0, worst_limit = 0.0;
  for (std::size_t i = 0; i < coverage.values.size(); ++i) {
    if (map.free_share(i) <= 0.0) continue;
    const double limit = greatest_coverage(spec, law.diameter(coverage.values[i]));
    const double excess = coverage.values[i] - limit;
    if (excess <= 1e-9) continue;
    ++short_cells;
    if (excess > worst_excess) {
      worst = i;
      worst_excess = excess;
      worst_limit = limit;
    }
    coverage.values[i] = limit;
  }
  if (short_cells == 0) return map;
  if (!spec.accept_shortfall) {
    const auto nx = static_cast<std::size_t>(map.grid().nx);
    refuse("mode",
           fmt::format(
               "must be able to hold the coverage of every cell: cell ({}, {}) asks for {:.4g}, these sizes and "
               "gap hold at most {:.4g}; {} cells of {} ask for too much (larger dots, a smaller gap, another "
               "mode, or accept_shortfall)",
               worst % nx, worst / nx, map.coverage().values[worst], worst_limit, short_cells, coverage.values.size()));
  }
  return CoverageMap(std::move(coverage), map.free());
}

void check_count(const DotSpec& spec, const CoverageMap& map) {
  double count = 0.0;
  const SizeLaw law(spec, map);
  for (std::size_t i = 0; i < map.coverage().values.size(); ++i) {
    count += spec.mode == DotMode::lattice ? map.free_share(i) * map.grid().cell_area() / lattice_place_area(spec)
                                           : map.wanted(i) / law.area(map.coverage().values[i]);
  }
  if (count > kMostDots)
    refuse(
        spec.mode == DotMode::lattice ? "pitch_um" : "diameter_um",
        fmt::format("must not make more than {:.0f} million dots, got {:.4g} million", kMostDots / 1e6, count / 1e6));
}

DotStore blue_noise(const DotSpec& spec, const CoverageMap& map, int threads, const std::stop_token& stop) {
  const SizeLaw law(spec, map);
  DotStore store = start_dots(spec, map, law, threads);
  relax(spec, map, law, {}, threads, store, stop);
  if (spec.mode == DotMode::both) {
    auto& dots = store.dots();
    for (std::size_t i = 0; i < store.size(); ++i)
      dots.diameter[i] = static_cast<float>(law.diameter(map.at(dots.x[i], dots.y[i])));
    fit_sizes(spec, map, spec.diameter_min, spec.diameter_max, true, threads, store);
  }
  return store;
}

/// The place in whole nm that is still within the cell.
double whole_nm(double mm, double low, double high) {
  const double first = std::ceil(low * kPerNm), last = std::max(first, std::ceil(high * kPerNm) - 1.0);
  return std::clamp(std::round(mm * kPerNm), first, last) / kPerNm;
}

}  // namespace

double greatest_coverage(const DotSpec& spec, double diameter) {
  if (spec.mode == DotMode::lattice)
    return core::footprint_area(spec.footprint, greatest_lattice_diameter(spec)) / lattice_place_area(spec);
  const double circle =
      core::footprint_area(core::Footprint::round, core::footprint_span(spec.footprint, diameter) + spec.gap);
  return kDensestPacking * core::footprint_area(spec.footprint, diameter) / circle;
}

Placement place_dots(const DotSpec& spec, const CoverageMap& asked, int threads, const std::stop_token& stop) {
  if (spec.mode == DotMode::lattice && !(greatest_lattice_diameter(spec) >= spec.diameter_min)) {
    refuse("pitch_um",
           fmt::format("must leave room for the least dot ({:g} um) and the gap ({:g} um), got {:g}",
                       spec.diameter_min / core::kMmPerUm, spec.gap / core::kMmPerUm, spec.pitch / core::kMmPerUm));
  }
  check_count(spec, asked);
  Placement result;
  result.wanted_area = asked.wanted_in_all();
  const CoverageMap map = possible_map(spec, asked, result.short_cells);
  DotStore store = spec.mode == DotMode::lattice ? lattice_dots(spec, map) : blue_noise(spec, map, threads, stop);
  if (spec.mode == DotMode::lattice) {
    fit_sizes(spec, map, spec.diameter_min, greatest_lattice_diameter(spec), false, threads, store);
  } else if (!separate(spec, map, kSeparationSteps, threads, store, stop)) {
    result.removed = settle_conflicts(spec, map, store, stop);
  }
  const auto& dots = store.dots();
  result.dots.resize(store.size());
  const core::CellGrid& g = map.grid();
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) {
    const auto [x0, y0] = cell_corner(g, cell);
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
      const double diameter = static_cast<double>(dots.diameter[i]);
      result.dots[i] = {whole_nm(dots.x[i], x0, x0 + g.dx), whole_nm(dots.y[i], y0, y0 + g.dy),
                        static_cast<float>(0.5 * diameter), static_cast<float>(spec.angle)};
      result.area += core::footprint_area(spec.footprint, diameter);
    }
  }
  if (result.dots.empty())
    refuse("", "must place at least one dot, got none: the density or the free area is too small");
  return result;
}

}  // namespace evenglow::design
