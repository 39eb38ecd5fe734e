#include "design/tolerance/dot_change.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "design/dots/lattice.h"
#include "design/dots/size_law.h"
#include "design/tolerance/distribution.h"

namespace evenglow::design {
namespace {

double lattice_diameter(const DotSpec& spec, double coverage) {
  const double unit = core::footprint_area(spec.footprint, 1.0);
  return std::clamp(std::sqrt(coverage * lattice_place_area(spec) / unit), spec.diameter_min,
                    greatest_lattice_diameter(spec));
}

/// Moves dots over the border between two cells.
struct Border {
  std::size_t from, to;
  double length;  // mm
};

template <typename Visit>
void for_each_border(const core::CellGrid& grid, Visit&& visit) {
  for (int iy = 0; iy < grid.ny; ++iy) {
    for (int ix = 0; ix < grid.nx; ++ix) {
      const std::size_t i =
          static_cast<std::size_t>(iy) * static_cast<std::size_t>(grid.nx) + static_cast<std::size_t>(ix);
      if (ix + 1 < grid.nx) visit(Border{i, i + 1, grid.dy});
      if (iy + 1 < grid.ny) visit(Border{i, i + static_cast<std::size_t>(grid.nx), grid.dx});
    }
  }
}

}  // namespace

DotModel dot_model(const core::CellField& density, double fill, const DotSpec& spec) {
  DotModel model{spec.footprint, density, fill};
  core::CellField coverage = density;
  for (double& value : coverage.values) value = std::clamp(value * fill, 0.0, 1.0);
  if (spec.mode == DotMode::lattice) {
    for (std::size_t i = 0; i < coverage.values.size(); ++i)
      model.diameter.values[i] = lattice_diameter(spec, coverage.values[i]);
    return model;
  }
  const core::CellGrid& g = density.grid;
  const FreeArea whole({g.x0, g.x0 + g.nx * g.dx, g.y0, g.y0 + g.ny * g.dy}, {}, {}, {});
  const SizeLaw law(spec, CoverageMap(coverage, whole));
  for (std::size_t i = 0; i < coverage.values.size(); ++i) model.diameter.values[i] = law.diameter(coverage.values[i]);
  return model;
}

double exchange(core::Footprint footprint, double diameter, double spread) {
  if (!(spread > 0.0)) return 0.0;
  const double area = core::footprint_area(footprint, diameter);
  const double ramp = footprint == core::Footprint::square
                          ? diameter
                          : 3.0 * std::numbers::pi * std::numbers::pi / 16.0 * 0.5 * diameter;
  const auto moved = [&](double t) {  // G(t) / area^2
    return t > ramp ? t - ramp / 3.0 : t * t / ramp * (1.0 - t / (3.0 * ramp));
  };
  // The difference of two shifts is normal with sqrt(2) times their spread: the mean over its size, by the midpoint
  // rule.
  constexpr int kSteps = 200;
  constexpr double kReach = 6.0;
  double mean = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    const double z = kReach * (i + 0.5) / kSteps;
    mean += std::exp(-0.5 * z * z) * moved(std::numbers::sqrt2 * spread * z);
  }
  mean *= 2.0 / std::sqrt(2.0 * std::numbers::pi) * kReach / kSteps;
  return 0.5 * area * area * mean;
}

core::CellField changed_density(const core::CellField& density, const DotModel& model, const DotChange& change,
                                core::PhotonRng& sizes, core::PhotonRng& places) {
  const core::CellGrid& grid = density.grid;
  const double s2 = change.size_spread * change.size_spread;
  core::CellField covered = density;
  std::vector<double> dot_area(density.values.size());  // drawn
  std::vector<double> gain(density.values.size());      // of a dot's area, on average
  std::vector<double> drift(density.values.size());     // area that changes sides, variance for each mm
  for (std::size_t i = 0; i < density.values.size(); ++i) {
    const double coverage = density.values[i] * model.fill, d = model.diameter.values[i];
    const double made = std::max(0.0, d + change.growth.values[i]);
    dot_area[i] = core::footprint_area(model.footprint, d);
    gain[i] = made > 0.0 ? (made * made + s2) / (d * d) : 0.0;
    const double scatter = (4.0 * made * made * s2 + 2.0 * s2 * s2) / (d * d * d * d);
    covered.values[i] =
        coverage * gain[i] + draw_normal(sizes) * std::sqrt(coverage * dot_area[i] / grid.cell_area() * scatter);
    const double count = coverage / dot_area[i];  // for each mm2
    drift[i] = count > 0.0 ? count * exchange(model.footprint, std::sqrt(gain[i]) * d, change.place_spread) : 0.0;
  }
  for_each_border(grid, [&](const Border& border) {
    const double variance = 0.5 * (drift[border.from] + drift[border.to]) * border.length;
    const double moved = draw_normal(places) * std::sqrt(variance) / grid.cell_area();
    covered.values[border.from] -= moved;
    covered.values[border.to] += moved;
  });
  for (double& value : covered.values) value = std::clamp(value / model.fill, 0.0, 1.0);
  return covered;
}

}  // namespace evenglow::design
