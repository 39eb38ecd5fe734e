#include "design/dots/scaled_sizes.h"

#include <algorithm>
#include <cmath>

#include "design/dots/dot_store.h"

namespace evenglow::design {
namespace {

DotStore stored(const core::CellGrid& cells, const core::DotPattern& dots, int threads) {
  std::vector<int> counts(cells.size(), 0);
  counts[0] = static_cast<int>(dots.size());
  DotStore store(cells, counts);
  const double spacing =
      std::sqrt(cells.cell_area() * static_cast<double>(cells.size()) / static_cast<double>(dots.size()));
  for (std::size_t i = 0; i < dots.size(); ++i) {
    store.dots().x[i] = dots[i].x;
    store.dots().y[i] = dots[i].y;
    store.dots().diameter[i] = 2.0f * dots[i].radius;
    store.dots().spacing[i] = static_cast<float>(spacing);
  }
  store.sort_all(threads);
  return store;
}

/// The greatest diameter that the neighbors and the free area leave dot `i`, at most `greatest`.
double room(const DotSpec& spec, const FreeArea& free, const DotStore& store, std::size_t i, double greatest) {
  const auto& dots = store.dots();
  const double per_span = 1.0 / core::footprint_span(spec.footprint, 1.0);
  double span = core::footprint_span(spec.footprint, greatest);
  const double reach = span + spec.gap;
  span = std::min(span, 2.0 * free.clearance(dots.x[i], dots.y[i], greatest));
  store.near(dots.x[i], dots.y[i], reach, [&](std::size_t j) {
    if (j == i) return;
    const double distance = std::hypot(dots.x[j] - dots.x[i], dots.y[j] - dots.y[i]);
    const double other = core::footprint_span(spec.footprint, static_cast<double>(dots.diameter[j]));
    span = std::min(span, 2.0 * (distance - spec.gap) - other);
  });
  return span * per_span;
}

}  // namespace

core::DotPattern scaled_sizes(const DotSpec& spec, const FreeArea& free, const core::CellGrid& cells,
                              const core::DotPattern& dots, const std::function<double(double, double)>& factor,
                              int threads) {
  if (dots.empty()) return {};
  DotStore store = stored(cells, dots, threads);
  auto& all = store.dots();
  const double unit = core::footprint_area(spec.footprint, 1.0);
  const double first = std::ceil(spec.diameter_min / spec.size_step - 1e-6);
  const double last = std::floor(spec.diameter_max / spec.size_step + 1e-6);
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) {
    double carried = 0.0;  // mm2
    for (std::size_t i = store.begin(cell); i < store.end(cell); ++i) {
      const double now = static_cast<double>(all.diameter[i]);
      const double area = core::footprint_area(spec.footprint, now) * factor(all.x[i], all.y[i]);
      double steps = std::round(std::sqrt(std::max(area + carried, 0.0) / unit) / spec.size_step);
      const double held = std::round(now / spec.size_step);
      if (steps > held) {
        const double most = std::floor(room(spec, free, store, i, spec.diameter_max) / spec.size_step + 1e-6);
        steps = std::clamp(steps, held, std::max(held, most));
      }
      const double diameter = std::clamp(steps, first, last) * spec.size_step;
      carried += area - core::footprint_area(spec.footprint, diameter);
      // At a limit nothing can be caught up; a debt would make the next dots odd.
      const double one_step = 2.0 * unit * diameter * spec.size_step;
      carried = std::clamp(carried, -one_step, one_step);
      all.diameter[i] = static_cast<float>(diameter);
    }
  }
  core::DotPattern result(store.size());
  for (std::size_t i = 0; i < result.size(); ++i)
    result[i] = {all.x[i], all.y[i], 0.5f * all.diameter[i], static_cast<float>(spec.angle)};
  return result;
}

}  // namespace evenglow::design
