#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Stochastic approximation of the root of ln(luminance / target) (Robbins and Monro, Ann. Math. Stat. 22 (1951) 400)
/// in ln density, cell by cell: x <- x - a / (1 + n) ln(L / mean L), with the gains of Kesten (Ann. Math. Stat. 29
/// (1958) 41): n is the number of times that the sign of the cell's own error has changed, so that gains stay large on
/// the way and fall only where noise begins to rule. a: the key `power`. It averages the noise of many small traces;
/// nothing is smoothed.
std::unique_ptr<const Updater> make_stochastic_approximation_updater();

}  // namespace evenglow::design
