#include "design/updaters/noise_aware_ratio_updater.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include "design/problem/regrid.h"
#include "design/updaters/box_blur.h"
#include "design/updaters/log_step.h"

namespace evenglow::design {
namespace {

using core::CellField;

// Gaussians that bound the bands, in cells; 0 is the field itself.
constexpr double kScales[] = {0.0, 0.7, 1.4, 2.8, 5.6, 11.2};
constexpr int kBands = static_cast<int>(std::size(kScales));
/// Windows of the local energies, in units of a band's scale along x and y: of the signal, and of the noise beside it.
struct Window {
  double x, y;
  double noise_x, noise_y;
};
// The long ones find what follows an edge with LEDs. The noise changes slowly from place to place, so that its windows
// are wide: its energy is known well, and only that of the signal is left to chance.
constexpr Window kWindows[] = {{2.0, 2.0, 8.0, 8.0}, {0.7, 8.0, 8.0, 16.0}, {8.0, 0.7, 16.0, 8.0}};
// With one window 2 would do (theory.md). Of three the most counts: each has to stand out further.
constexpr double kLambda = 2.5;
constexpr double kLocalScale = 1.5;  // cells, of the local mean luminance
constexpr double kFloor = 0.05;      // least luminance of a cell over its local mean

CellField difference(const CellField& a, const CellField& b) {
  CellField result = a;
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] -= b.values[i];
  return result;
}

CellField squared(CellField field) {
  for (double& value : field.values) value *= value;
  return field;
}

/// Band `i` in x: between the scales i and i + 1; the last band holds all that is coarser.
CellField band_x(const CellField& field, int i) {
  CellField fine = core::smooth_gaussian(field, kScales[i], 0.0);
  return i + 1 < kBands ? difference(fine, core::smooth_gaussian(field, kScales[i + 1], 0.0)) : fine;
}

CellField band_y(const CellField& field, int i) {
  CellField fine = core::smooth_gaussian(field, 0.0, kScales[i]);
  return i + 1 < kBands ? difference(fine, core::smooth_gaussian(field, 0.0, kScales[i + 1])) : fine;
}

/// The width that the details of a band have.
double scale_of(int band) {
  return kScales[std::min(band + 1, kBands - 1)];
}

/// The share of each cell of the band (i, j) that stands out of its noise, the most that a window shows.
CellField significant_share(const CellField& band, const CellField& noise_band, int i, int j) {
  CellField share(band.grid, 0.0);
  const CellField signal_squares = squared(band), noise_squares = squared(noise_band);
  for (const Window& window : kWindows) {
    const CellField energy = blur(signal_squares, window.x * scale_of(i), window.y * scale_of(j));
    const CellField noise = blur(noise_squares, window.noise_x * scale_of(i), window.noise_y * scale_of(j));
    for (std::size_t k = 0; k < share.values.size(); ++k) {
      if (energy.values[k] <= 0.0) continue;
      share.values[k] = std::max(share.values[k], 1.0 - kLambda * noise.values[k] / energy.values[k]);
    }
  }
  return share;
}

/// Half the difference of the maps of even and odd batches (equal numbers of each), over the local mean of a map of
/// all.
CellField noise_sample(const core::Tally& tally, const CellField& local) {
  CellField result(local.grid, 0.0);
  const std::size_t pairs = tally.batches() / 2;
  CellField sum = result;
  for (std::size_t b = 0; b < 2 * pairs; ++b) {
    const auto& batch = tally.batch(b);
    for (std::size_t i = 0; i < batch.size(); ++i) {
      result.values[i] += b % 2 == 0 ? batch[i] : -batch[i];
      sum.values[i] += batch[i];
    }
  }
  const double mean = sum.mean();
  const double scale = mean / local.mean();
  for (std::size_t i = 0; i < result.values.size(); ++i) {
    result.values[i] /= std::max(scale * local.values[i], 1e-3 * mean);
  }
  return result;
}

class NoiseAwareRatioUpdater final : public Updater {
 public:
  Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory&) const override {
    return take_step(state, spec, ratio_step(state, spec, noise_aware_excess(state).field));
  }
};

}  // namespace

Denoised denoise(const CellField& field, const CellField& noise) {
  Denoised result{{field.grid, 0.0}, {field.grid, 0.0}};
  for (int i = 0; i < kBands; ++i) {
    const CellField field_x = band_x(field, i);
    const CellField noise_x = band_x(noise, i);
    for (int j = 0; j < kBands; ++j) {
      const CellField band = band_y(field_x, j);
      const CellField noise_band = band_y(noise_x, j);
      const bool coarsest = i + 1 == kBands && j + 1 == kBands;
      if (coarsest) {
        for (std::size_t k = 0; k < band.values.size(); ++k) {
          result.field.values[k] += band.values[k];
          result.noise.values[k] += noise_band.values[k];
        }
      } else {
        const CellField share = significant_share(band, noise_band, i, j);
        for (std::size_t k = 0; k < band.values.size(); ++k) {
          result.field.values[k] += share.values[k] * band.values[k];
          result.noise.values[k] += share.values[k] * noise_band.values[k];
        }
      }
    }
  }
  return result;
}

Denoised noise_aware_excess(const DesignState& state) {
  const CellField& luminance = state.observation.map.luminance;
  const double mean = luminance.mean();
  const CellField density = regrid(state.density.cells, luminance.grid);
  const CellField local = core::smooth_gaussian(luminance, kLocalScale);
  CellField response = luminance;
  for (std::size_t i = 0; i < response.values.size(); ++i) {
    // A cell that few photons reached must not pull the logarithm down without bound.
    const double floor = kFloor * std::max(local.values[i], 1e-3 * mean);
    response.values[i] = std::log(std::max(luminance.values[i], floor) / mean / density.values[i]);
  }
  Denoised excess = denoise(response, noise_sample(state.observation.luminance, local));
  for (std::size_t i = 0; i < response.values.size(); ++i) excess.field.values[i] += std::log(density.values[i]);
  const double level = excess.field.mean();
  for (double& value : excess.field.values) value -= level;
  return excess;
}

std::unique_ptr<const Updater> make_noise_aware_ratio_updater() {
  return std::make_unique<NoiseAwareRatioUpdater>();
}

}  // namespace evenglow::design
