#include "design/dots/lattice.h"

#include <algorithm>
#include <cmath>

#include "core/base/error.h"

namespace evenglow::design {
namespace {

/// The lattice turned about the center of the plate: place (i, j) and the range of both that covers the plate.
struct Places {
  double x0, y0, cos_a, sin_a, pitch, row_pitch, shift;
  int half;  ///< i and j run from -half to half

  Places(const DotSpec& spec, const core::CellGrid& g)
      : x0(g.x0 + 0.5 * g.nx * g.dx),
        y0(g.y0 + 0.5 * g.ny * g.dy),
        cos_a(std::cos(spec.lattice_angle)),
        sin_a(std::sin(spec.lattice_angle)),
        pitch(spec.pitch),
        row_pitch(spec.lattice == DotLattice::square ? spec.pitch : spec.pitch * std::sqrt(0.75)),
        shift(spec.lattice == DotLattice::square ? 0.0 : 0.5),
        half(static_cast<int>(std::ceil(0.5 * std::hypot(g.nx * g.dx, g.ny * g.dy) / row_pitch)) + 1) {}

  double x(int i, int j) const { return x0 + cos_a * along(i, j) - sin_a * j * row_pitch; }
  double y(int i, int j) const { return y0 + sin_a * along(i, j) + cos_a * j * row_pitch; }

 private:
  double along(int i, int j) const { return (i + shift * (j & 1)) * pitch; }
};

struct Placed {
  double x, y;
  float diameter;
  std::size_t cell;
};

/// Takes dots evenly out of cells that hold too much even if all of their dots were the least ones.
void thin_out(const CoverageMap& map, double least, std::vector<Placed>& dots) {
  std::vector<double> count(map.grid().size(), 0.0);
  for (const Placed& dot : dots) count[dot.cell] += 1.0;
  std::vector<double> kept(count.size(), 1.0), carried(count.size(), 0.5);
  for (std::size_t cell = 0; cell < count.size(); ++cell) {
    const double most = std::max(std::round(map.wanted(cell) / least), 0.0);
    if (count[cell] > most) kept[cell] = most / count[cell];
  }
  std::erase_if(dots, [&](const Placed& dot) {
    carried[dot.cell] += kept[dot.cell];
    if (carried[dot.cell] < 1.0 - 1e-9) return true;
    carried[dot.cell] -= 1.0;
    return false;
  });
}

}  // namespace

double lattice_place_area(const DotSpec& spec) {
  return spec.pitch * spec.pitch * (spec.lattice == DotLattice::square ? 1.0 : std::sqrt(0.75));
}

double greatest_lattice_diameter(const DotSpec& spec) {
  const double room = (spec.pitch - spec.gap) / core::footprint_span(spec.footprint, 1.0);
  return std::min(spec.diameter_max, std::floor(room / spec.size_step + 1e-6) * spec.size_step);
}

DotStore lattice_dots(const DotSpec& spec, const CoverageMap& map) {
  const Places places(spec, map.grid());
  const double place_area = lattice_place_area(spec), unit = core::footprint_area(spec.footprint, 1.0);
  const double least = unit * spec.diameter_min * spec.diameter_min;
  const double greatest = unit * std::pow(greatest_lattice_diameter(spec), 2);
  std::vector<Placed> found;
  const auto width = 2 * static_cast<std::size_t>(places.half) + 3;
  std::vector<double> here(width, 0.0), next(width, 0.0);
  for (int j = -places.half; j <= places.half; ++j) {
    const int way = (j & 1) == 0 ? 1 : -1;
    for (int step = -places.half; step <= places.half; ++step) {
      const int i = way * step;
      const double x = places.x(i, j), y = places.y(i, j);
      const int cell = map.grid().index_at(x, y);
      if (cell < 0 || map.free().clearance(x, y, 1.0) <= 0.0) continue;
      const std::ptrdiff_t column = std::ptrdiff_t{i} + places.half + 1;
      const auto at = [](std::vector<double>& row, std::ptrdiff_t place) -> double& {
        return row[static_cast<std::size_t>(place)];
      };
      const double wanted = map.at(x, y) * place_area, ask = wanted + at(here, column);
      double area = std::min(wanted, greatest);
      if (wanted < least) {
        area = ask > 0.5 * least ? least : 0.0;
        const double error = std::clamp(ask - area, -least, least);
        at(here, column + way) += error * 7.0 / 16.0;
        at(next, column - way) += error * 3.0 / 16.0;
        at(next, column) += error * 5.0 / 16.0;
        at(next, column + way) += error * 1.0 / 16.0;
      }
      if (area == 0.0) continue;
      const double diameter = std::sqrt(area / unit);
      const double half = 0.5 * core::footprint_span(spec.footprint, diameter);
      if (map.free().clearance(x, y, 2.0 * half) < half) continue;
      found.push_back({x, y, static_cast<float>(diameter), static_cast<std::size_t>(cell)});
    }
    here.swap(next);
    std::fill(next.begin(), next.end(), 0.0);
  }
  thin_out(map, least, found);
  std::vector<int> counts(map.grid().size(), 0);
  for (const Placed& dot : found) ++counts[dot.cell];
  DotStore store(map.grid(), counts);
  std::vector<std::size_t> at(counts.size());
  for (std::size_t cell = 0; cell < at.size(); ++cell) at[cell] = store.begin(cell);
  for (const Placed& dot : found) {
    const std::size_t i = at[dot.cell]++;
    store.dots().x[i] = dot.x;
    store.dots().y[i] = dot.y;
    store.dots().diameter[i] = dot.diameter;
    store.dots().spacing[i] = static_cast<float>(spec.pitch);
  }
  for (std::size_t cell = 0; cell < store.cell_count(); ++cell) store.sort(cell);
  return store;
}

}  // namespace evenglow::design
