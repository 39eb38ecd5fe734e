#pragma once

#include "core/math/cell_field.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::design {

/// A random field with mean 0, standard deviation 1 and the correlation exp(-r^2 / (2 length^2)) at the distance r
/// (mm), at the centers of the cells: a sum of 64 plane waves whose directions, lengths and phases are drawn (random
/// Fourier features, Rahimi & Recht, NIPS 2007). Correlation and deviation hold on average over many fields; the values
/// at a point are nearly normal.
core::CellField smooth_field(const core::CellGrid& grid, double length, core::PhotonRng& rng);

}  // namespace evenglow::design
