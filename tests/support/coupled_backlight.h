#pragma once

#include <random>
#include <vector>

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>

#include "core/montecarlo/tally.h"
#include "design/problem/design_state.h"
#include "design/problem/regrid.h"

namespace evenglow::tests {

/// A backlight without photons whose cells are strongly coupled: guided light phi diffuses through the plate,
///
///     - D laplace phi + (loss + out density) phi = source at the edges lit        luminance = out density phi +
///     returned
///
/// solved exactly; a share of what leaves comes back spread over the whole plate and enters again (recycling films).
/// Where out density >> loss all light leaves somewhere, so that a cell that gives more takes from its neighbors: the
/// worst case for updates that take cells as independent. Noise: Gaussian in each cell of each batch, relative size
/// `noise` at 1e6 photons.
struct CoupledBacklight {
  core::CellGrid grid = core::CellGrid::over(32, 18, 0.0, 0.0, 32.0, 18.0);
  double diffusion = 40.0;  ///< mm2, of light
  double out = 2.0;         ///< at density 1
  double loss = 0.002;
  double recycled = 0.3;  ///< share of what leaves that comes back, evenly
  bool left = true, right = false, front = false, back = false;
  double noise = 0.02;
  std::size_t batches = 20;
  unsigned seed = 1;

  /// Light that leaves each cell.
  std::vector<double> luminance(const core::CellField& density) const {
    const int nx = grid.nx, ny = grid.ny;
    const auto n = static_cast<Eigen::Index>(grid.size());
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd source = Eigen::VectorXd::Zero(n);
    for (int iy = 0; iy < ny; ++iy) {
      for (int ix = 0; ix < nx; ++ix) {
        const int i = iy * nx + ix;
        double diagonal = loss + out * density.values[static_cast<std::size_t>(i)];
        const auto couple = [&](bool inside, int j, double width) {
          if (!inside) return;
          entries.emplace_back(i, j, -diffusion / (width * width));
          diagonal += diffusion / (width * width);
        };
        couple(ix > 0, i - 1, grid.dx);
        couple(ix + 1 < nx, i + 1, grid.dx);
        couple(iy > 0, i - nx, grid.dy);
        couple(iy + 1 < ny, i + nx, grid.dy);
        entries.emplace_back(i, i, diagonal);
        source[i] = (left && ix == 0 ? 1.0 + 0.5 * (iy % 6 < 3) : 0.0) + (right && ix + 1 == nx ? 1.0 : 0.0) +
                    (front && iy == 0 ? 1.0 : 0.0) + (back && iy + 1 == ny ? 1.0 : 0.0);
      }
    }
    const double power = source.sum();
    Eigen::SparseMatrix<double> matrix(n, n);
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
    const Eigen::VectorXd direct = solver.solve(source);
    const Eigen::VectorXd even = solver.solve(Eigen::VectorXd::Constant(n, power / static_cast<double>(n)));
    // Both solutions hold light of the same power; returned light adds the second one again and again.
    double gone = 0.0, gone_even = 0.0;
    std::vector<double> light(grid.size());
    for (Eigen::Index i = 0; i < n; ++i) {
      gone += out * density.values[static_cast<std::size_t>(i)] * direct[i];
      gone_even += out * density.values[static_cast<std::size_t>(i)] * even[i];
    }
    const double again = recycled * gone / power / (1.0 - recycled * gone_even / power);
    for (Eigen::Index i = 0; i < n; ++i) {
      light[static_cast<std::size_t>(i)] = (1.0 - recycled) * out * density.values[static_cast<std::size_t>(i)] *
                                           (direct[i] + again * even[i]) / power * static_cast<double>(n);
    }
    return light;
  }

  double efficiency(const core::CellField& density) const {
    double sum = 0.0;
    for (const double value : luminance(density)) sum += value / static_cast<double>(grid.size());
    return sum;
  }

  /// RMS of luminance over target: no noise at all.
  double true_rms(const core::CellField& density, const std::vector<double>* target = nullptr) const {
    std::vector<double> light = luminance(density);
    double mean = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < light.size(); ++i) {
      if (target != nullptr) light[i] /= (*target)[i];
      mean += light[i] / static_cast<double>(light.size());
    }
    for (const double value : light) squares += (value - mean) * (value - mean) / static_cast<double>(light.size());
    return std::sqrt(squares) / mean;
  }

  std::optional<design::Observation> operator()(const tracer::DensityField& density, std::uint64_t photons,
                                                std::uint32_t step) const {
    const std::vector<double> light = luminance(design::regrid(density.cells, grid));
    std::mt19937_64 random(seed * 1000003ULL + step);
    std::normal_distribution<double> normal;
    const double batch_noise = noise * std::sqrt(1e6 / static_cast<double>(photons) * static_cast<double>(batches));
    design::Observation o;
    o.photons = photons;
    o.luminance = core::Tally(grid.size());
    const double cells = static_cast<double>(grid.size());
    for (std::size_t b = 0; b < batches; ++b) {
      std::vector<double> batch = light;
      double flux = 0.0;
      for (double& value : batch) {
        value *= (1.0 + batch_noise * normal(random)) / static_cast<double>(batches);
        flux += value * static_cast<double>(batches) / cells;
      }
      o.efficiency_batches.push_back(flux);
      o.luminance.add_batch(std::move(batch));
    }
    o.map = {{grid, 0.0}, {grid, 0.0}};
    for (std::size_t i = 0; i < grid.size(); ++i) {
      const core::Estimate e = o.luminance.total(i);
      o.map.luminance.values[i] = e.value;
      o.map.standard_error.values[i] = e.se;
    }
    std::vector<double> parts = o.efficiency_batches;
    for (double& part : parts) part /= static_cast<double>(batches);
    o.efficiency = core::total_of_batches(parts);
    return o;
  }
};

}  // namespace evenglow::tests
