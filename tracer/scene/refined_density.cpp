#include "tracer/scene/refined_density.h"

#include <algorithm>
#include <cstddef>

#include "core/base/error.h"
#include "core/math/cell_index.h"

namespace evenglow::tracer {
namespace {

using core::CellField;

/// The parts of one cell, row by row.
class CellParts {
 public:
  CellParts(CellField& fine, int subcells, int ix, int iy) : fine_(fine), n_(subcells), ix_(ix), iy_(iy) {}

  template <typename Visit>
  void each(Visit visit) {
    for (int j = 0; j < n_; ++j) {
      for (int i = 0; i < n_; ++i) visit(fine_.values[core::cell_index(fine_.grid.nx, ix_ * n_ + i, iy_ * n_ + j)]);
    }
  }

 private:
  CellField& fine_;
  int n_, ix_, iy_;
};

/// The mean of the parts becomes `mean`, and they stay in [low, high].
void keep_mean(CellParts parts, double count, double mean, double low, double high) {
  double sum = 0.0;
  parts.each([&](double& value) { sum += value; });
  const double own = sum / count;
  double share = 1.0;
  parts.each([&](double& value) {
    const double off = value - own;
    if (off > 0.0) share = std::min(share, (high - mean) / off);
    if (off < 0.0) share = std::min(share, (low - mean) / off);
  });
  parts.each([&](double& value) { value = std::clamp(mean + share * (value - own), low, high); });
}

}  // namespace

DensityField refined(const DensityField& density, int subcells) {
  core::expects(subcells >= 1, "at least one part of a cell");
  if (subcells == 1) return density;
  const CellField& cells = density.cells;
  core::CellGrid grid = cells.grid;
  grid.nx *= subcells;
  grid.ny *= subcells;
  grid.dx /= subcells;
  grid.dy /= subcells;
  DensityField result{core::resample_bilinear(cells, grid)};
  const double low = cells.min(), high = cells.max();
  const double count = static_cast<double>(subcells) * subcells;
  for (int iy = 0; iy < cells.grid.ny; ++iy) {
    for (int ix = 0; ix < cells.grid.nx; ++ix) {
      const double mean = cells.values[core::cell_index(cells.grid.nx, ix, iy)];
      keep_mean(CellParts(result.cells, subcells, ix, iy), count, mean, low, high);
    }
  }
  return result;
}

DensityField traced_density(const BacklightSpec& spec, const DensityField& density) {
  return refined(density, spec.microstructure ? spec.microstructure->subcells : 1);
}

}  // namespace evenglow::tracer
