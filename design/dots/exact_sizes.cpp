#include "design/dots/exact_sizes.h"

#include <algorithm>
#include <cmath>

#include "design/dots/start_dots.h"

namespace evenglow::design {
namespace {

constexpr double kMostScaling = 0.2;  // of the area, in each pass
constexpr int kPasses = 4;
constexpr double kTolerance = 0.8;  // of a dot's area, where the scaling is to be least

double scaling(double held, double wanted, double dot, bool full) {
  if (!(held > 0.0)) return 1.0;
  const double slack = full ? 0.0 : kTolerance * dot;
  const double target = std::clamp(held, wanted - slack, wanted + slack);
  return std::clamp(target / held, 1.0 - kMostScaling, 1.0 + kMostScaling);
}

}  // namespace

void fit_sizes(const DotSpec& spec, const CoverageMap& map, double least, double greatest, bool full, int threads,
               DotStore& store) {
  auto& diameters = store.dots().diameter;
  const double unit = core::footprint_area(spec.footprint, 1.0);
  const double first = std::ceil(least / spec.size_step - 1e-6), last = std::floor(greatest / spec.size_step + 1e-6);
  for_each_cell(store.cell_count(), threads, [&](std::size_t cell) {
    const std::size_t begin = store.begin(cell), end = store.end(cell);
    // Again and again, as dots at a limit leave their part to the others.
    for (int pass = 0; pass < kPasses; ++pass) {
      double held = 0.0;
      for (std::size_t i = begin; i < end; ++i)
        held += core::footprint_area(spec.footprint, static_cast<double>(diameters[i]));
      const double dot = held / std::max(static_cast<double>(end - begin), 1.0);
      const double factor = std::sqrt(scaling(held, map.wanted(cell), dot, full));
      if (factor == 1.0) break;
      for (std::size_t i = begin; i < end; ++i) {
        const double diameter = static_cast<double>(diameters[i]) * factor;
        diameters[i] = static_cast<float>(std::clamp(diameter, first * spec.size_step, last * spec.size_step));
      }
    }
    double carried = 0.0;  // mm2
    for (std::size_t i = begin; i < end; ++i) {
      const double area = core::footprint_area(spec.footprint, static_cast<double>(diameters[i]));
      const double ask = std::sqrt(std::max(area + carried, 0.0) / unit) / spec.size_step;
      // Nor may a dot grow over a border of the free area.
      const double room = 2.0 / core::footprint_span(spec.footprint, 1.0) *
                          map.free().clearance(store.dots().x[i], store.dots().y[i], greatest);
      const double most = std::max(first, std::min(last, std::floor(room / spec.size_step + 1e-6)));
      const double steps = std::clamp(std::round(ask), first, most);
      const double diameter = steps * spec.size_step;
      carried += area - core::footprint_area(spec.footprint, diameter);
      // At a limit nothing can be caught up; a debt would make the next dots odd.
      const double one_step = 2.0 * unit * diameter * spec.size_step;
      carried = std::clamp(carried, -one_step, one_step);
      diameters[i] = static_cast<float>(diameter);
    }
  });
}

}  // namespace evenglow::design
