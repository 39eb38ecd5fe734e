#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Chooses by what the design shows. Where at least a hundredth of a trace's histories fit the memory it is `path_reuse`
/// (a traced map with few records tells small changes of the density nearly as well as with all: reused_histories.h).
/// Else it begins with `ratio_noise_aware`, the best where a cell's light depends on its
/// own density above all. If the RMS then falls by less than a factor of 3 in a step although the noise of the step
/// before cannot explain what is left, the cells are coupled, and it goes on with `anderson`; back again after an
/// accelerated step that made the RMS significantly worse (twice at most). Each change is told in the log.
std::unique_ptr<const Updater> make_auto_updater();

}  // namespace evenglow::design
