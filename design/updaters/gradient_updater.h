#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// A generic optimizer on all cells at once, as the yardstick of what derivatives alone are worth: NLopt's L-BFGS
/// (Nocedal, Math. Comput. 35 (1980) 773; Luksan's code) or MMA (Svanberg, SIAM J. Optim. 12 (2002) 555) on the squared
/// RMS that the histories of the trace give, and its gradient by the score function (history_merit.h). No photon is
/// traced for it. It ends
///
/// 1. where the squared RMS falls to the noise that the trace has (discrepancy principle: Morozov 1966): from there on
/// it
///    would fit noise;
/// 2. where the trace is worth less than a quarter of its photons;
/// 3. after `evaluations` values.
///
/// The best density that was evaluated is proposed; the ratio step where there is none, and without records.
std::unique_ptr<const Updater> make_gradient_updater();

}  // namespace evenglow::design
