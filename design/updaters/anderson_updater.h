#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Anderson acceleration (D. G. Anderson, J. ACM 12 (1965) 547; type II as in Walker and Ni, SIAM J. Numer. Anal. 49
/// (2011) 1715) of the noise-aware ratio update, seen as a fixed-point map of x = ln density with the residual f = the
/// step that it would take:
///
///     gamma = argmin |f_k - sum_j gamma_j dF_j|^2 + ridge |gamma|^2
///     step  = f_k - sum_j gamma_j (dX_j + dF_j)            dX_j, dF_j: differences of the last steps
///
/// Steps whose residual has an RMS above 0.3 are not remembered: there the map is far from linear. Against the noise:
/// what the noise of f_k alone adds to its product with dF is taken off; cells at a limit have no say; the sum of
/// |gamma| is bounded; the memory is dropped when the RMS rose significantly after an accelerated step, and when the
/// level moved by more than a fifth.
std::unique_ptr<const Updater> make_anderson_updater();

/// The residual of the last step, remembered; gives the accelerated step if `accelerate` and enough is known, else the
/// residual itself. `noise_square`: mean square of the noise in `residual`.
core::CellField anderson_step(const core::CellField& residual, double noise_square, const DesignState& state,
                              const DesignSpec& spec, bool accelerate, UpdaterMemory& memory);

}  // namespace evenglow::design
