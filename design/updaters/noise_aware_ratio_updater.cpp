#include "design/updaters/noise_aware_ratio_updater.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "design/updaters/ratio_updater.h"

namespace evenglow::design {
namespace {

using core::CellField;

constexpr double kScales[] = {0.7, 1.4, 2.8, 5.6};  // cells
constexpr double kLambda = 2.0;
// Windows of the local energies, in units of the band's scale: wide enough that noise alone hardly ever passes lambda.
constexpr double kSignalWindow = 4.0;
constexpr double kNoiseWindow = 8.0;
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

/// The share of a band that stands out of its noise.
void shrink(CellField& band, const CellField& noise_band, double scale) {
  const CellField energy = core::smooth_gaussian(squared(band), kSignalWindow * scale);
  const CellField noise = core::smooth_gaussian(squared(noise_band), kNoiseWindow * scale);
  for (std::size_t i = 0; i < band.values.size(); ++i) {
    band.values[i] *= energy.values[i] > 0.0 ? std::max(0.0, 1.0 - kLambda * noise.values[i] / energy.values[i]) : 0.0;
  }
}

/// Half the difference of the maps of even and odd batches (equal numbers of each), over the local mean of a map of all.
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
  Proposal propose(const DesignState& state, const DesignSpec& spec) const override {
    const CellField& luminance = state.observation.map.luminance;
    const double mean = luminance.mean();
    const CellField density = core::resample_bilinear(state.density.cells, luminance.grid);
    const CellField local = core::smooth_gaussian(luminance, kLocalScale);
    CellField response = luminance;
    for (std::size_t i = 0; i < response.values.size(); ++i) {
      // A cell that few photons reached must not pull the logarithm down without bound.
      const double floor = kFloor * std::max(local.values[i], 1e-3 * mean);
      response.values[i] = std::log(std::max(luminance.values[i], floor) / mean / density.values[i]);
    }
    CellField excess = denoise(response, noise_sample(state.observation.luminance, local));
    for (std::size_t i = 0; i < excess.values.size(); ++i) excess.values[i] += std::log(density.values[i]);
    double level = 0.0;
    for (const double value : excess.values) level += value;
    level /= static_cast<double>(excess.values.size());
    for (double& value : excess.values) value -= level;
    return apply_ratio(state, spec, excess);
  }
};

}  // namespace

CellField denoise(const CellField& field, const CellField& noise) {
  CellField result(field.grid, 0.0);
  CellField fine = field;
  CellField fine_noise = noise;
  for (const double scale : kScales) {
    CellField coarse = core::smooth_gaussian(field, scale);
    CellField band = difference(fine, coarse);
    CellField coarse_noise = core::smooth_gaussian(noise, scale);
    shrink(band, difference(fine_noise, coarse_noise), scale);
    for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += band.values[i];
    fine = std::move(coarse);
    fine_noise = std::move(coarse_noise);
  }
  for (std::size_t i = 0; i < result.values.size(); ++i) result.values[i] += fine.values[i];
  return result;
}

std::unique_ptr<const Updater> make_noise_aware_ratio_updater() {
  return std::make_unique<NoiseAwareRatioUpdater>();
}

}  // namespace evenglow::design
