#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Solves the design on the histories of the traces so far (reused_histories.h): inner steps of the noise-aware ratio
/// update with Anderson's acceleration, each on the re-weighted luminance, without a photon. They end
///
/// 1. where the noise-corrected RMS of the records is not above 0 (discrepancy principle: Morozov, Soviet Math. Dokl. 7
///    (1966) 414; what is left is noise), or the step is below a tenth of the noise that denoising left in it;
/// 2. where the records are worth less than a quarter of the newest trace's histories: the step that led there is taken
///    nevertheless, for it was found at a density that they know well;
/// 3. after 12 steps.
///
/// The next trace refreshes the histories there. Without records (models that give none) it is `ratio_noise_aware`.
std::unique_ptr<const Updater> make_path_reuse_updater();

/// The same for updaters that choose it.
Proposal reuse_paths(const DesignState& state, const DesignSpec& spec);

}  // namespace evenglow::design
