#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Chooses by what the design shows. It begins with `ratio_noise_aware`, the best where a cell's light depends on its
/// own density above all. If the RMS then falls by less than a factor of 3 in a step although the noise of the step
/// before cannot explain what is left, the cells are coupled, and it goes on with `anderson`; back again after an
/// accelerated step that made the RMS significantly worse (twice at most). Each change is told in the log.
std::unique_ptr<const Updater> make_auto_updater();

}  // namespace evenglow::design
