#pragma once

#include <random>

#include "core/montecarlo/tally.h"
#include "design/problem/design_state.h"

namespace evenglow::tests {

/// A backlight without photons for the design floor: light enters at x = 0 with the profile 1 + 0.3 cos(y), runs along
/// x and is let out in proportion to the density; a share of it comes back spread over the whole plate. Each cell of
/// each batch has Gaussian noise of relative size `noise` sqrt(batches reference 1e6 photons / photons of the batch).
struct AnalyticBacklight {
  core::CellGrid grid = core::CellGrid::over(24, 12, 0.0, 0.0, 24.0, 12.0);
  double coupling = 0.25;   ///< share let out by a cell of density 1
  double background = 0.1;  ///< light that does not depend on the cell's own density, share of the mean
  double noise = 0.02;      ///< of a cell at 1e6 photons
  std::size_t batches = 20;
  unsigned seed = 1;

  std::vector<double> luminance(const tracer::DensityField& density) const {
    std::vector<double> L(grid.size());
    double mean = 0.0;
    for (int iy = 0; iy < grid.ny; ++iy) {
      double flux = 1.0 + 0.3 * std::cos(iy);
      for (int ix = 0; ix < grid.nx; ++ix) {
        const auto i = static_cast<std::size_t>(iy * grid.nx + ix);
        const double out = flux * (1.0 - std::exp(-coupling * density.cells.values[i]));
        flux -= out;
        L[i] = out;
        mean += out / static_cast<double>(grid.size());
      }
    }
    for (double& value : L) value += background * mean;
    return L;
  }

  std::optional<design::Observation> operator()(const tracer::DensityField& density, std::uint64_t photons,
                                                std::uint32_t step) const {
    const std::vector<double> L = luminance(density);
    std::mt19937_64 random(seed * 1000003ULL + step);
    std::normal_distribution<double> normal;
    const double batch_noise = noise * std::sqrt(1e6 / static_cast<double>(photons) * static_cast<double>(batches));
    design::Observation o;
    o.photons = photons;
    o.luminance = core::Tally(grid.size());
    for (std::size_t b = 0; b < batches; ++b) {
      std::vector<double> batch = L;
      for (double& value : batch) value *= (1.0 + batch_noise * normal(random)) / static_cast<double>(batches);
      o.luminance.add_batch(std::move(batch));
    }
    o.map = {{grid, 0.0}, {grid, 0.0}};
    double flux = 0.0;
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const core::Estimate e = o.luminance.total(i);
      o.map.luminance.values[i] = e.value;
      o.map.standard_error.values[i] = e.se;
      flux += L[i];
    }
    o.efficiency = {flux / grid.ny / (1.0 + background), 1e-4};
    return o;
  }
};

}  // namespace evenglow::tests
