#pragma once

#include "core/math/cell_field.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

/// The ratio update on a response with its noise taken out.
///
/// What is smooth is not the luminance but the light that a unit of density sends out, ln(L / density). It is cut into
/// bands (differences of Gaussians of 0.7 to 11.2 cells, in x and in y apart, so that a bright line along an edge,
/// short across and long along it, has a band of its own with little noise); in each band every cell keeps the share
/// that stands out of the noise, the local Wiener factor max(0, 1 - lambda noise / energy), the most of three windows:
/// a square one, and long ones along x and y for what follows an edge (LEDs leave their marks in one column of cells).
/// The noise of a band is measured, not modeled: on half the difference of the maps of the even and of the odd batches,
/// which holds no signal and the very noise of their mean, with its correlations from cell to cell. Nothing is smoothed
/// that the trace can tell, so no bias is left once the photons grow.
std::unique_ptr<const Updater> make_noise_aware_ratio_updater();

/// A field with its noise taken out, and what is left of the noise in it.
struct Denoised {
  core::CellField field;
  core::CellField noise;  ///< a realization

  double noise_square() const {
    double sum = 0.0;
    for (const double value : noise.values) sum += value * value;
    return sum / static_cast<double>(noise.values.size());
  }
};

/// `field` denoised as told above; `noise`: a field that holds a realization of its noise and no signal.
Denoised denoise(const core::CellField& field, const core::CellField& noise);

/// ln(luminance / mean luminance) of each cell of the display with the noise taken out; mean 0.
Denoised noise_aware_excess(const DesignState& state);

}  // namespace evenglow::design
