#include "design/dots/dot_counts.h"

#include <algorithm>
#include <cmath>

#include "core/math/cell_index.h"

namespace evenglow::design {

std::vector<int> whole_counts(const core::CellField& wanted) {
  const core::CellGrid& g = wanted.grid;
  std::vector<int> counts(wanted.values.size());
  std::vector<double> carried(wanted.values.size(), 0.0);
  const auto pass = [&](int ix, int iy, double error) {
    if (ix < 0 || ix >= g.nx || iy >= g.ny) return;
    carried[core::cell_index(g.nx, ix, iy)] += error;
  };
  for (int iy = 0; iy < g.ny; ++iy) {
    const int way = iy % 2 == 0 ? 1 : -1;
    for (int step = 0; step < g.nx; ++step) {
      const int ix = way > 0 ? step : g.nx - 1 - step;
      const auto i = core::cell_index(g.nx, ix, iy);
      const double low = std::floor(wanted.values[i]);
      const double ask = wanted.values[i] + carried[i];
      const double count = wanted.values[i] == low ? low : std::clamp(std::round(ask), low, low + 1.0);
      counts[i] = static_cast<int>(count);
      const double error = std::clamp(ask - count, -1.0, 1.0);
      pass(ix + way, iy, error * 7.0 / 16.0);
      pass(ix - way, iy + 1, error * 3.0 / 16.0);
      pass(ix, iy + 1, error * 5.0 / 16.0);
      pass(ix + way, iy + 1, error * 1.0 / 16.0);
    }
  }
  return counts;
}

}  // namespace evenglow::design
