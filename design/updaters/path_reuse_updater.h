#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Solves the design on the histories of the traces so far (reused_histories.h): inner steps of the noise-aware ratio
/// update with Anderson's acceleration, each on the re-weighted luminance, without a photon. They end
///
/// 1. where the step is below a fifth of the noise that denoising left in it. All inner steps see the same noise, and
///    what denoising lets through of it does not grow with their number;
/// 2. where the traces are worth less than a quarter of the newest one's photons: the step that led there is taken
///    nevertheless, for it was found at a density that they know well;
/// 3. after 12 steps.
///
/// The proposal tells the RMS that the histories foresee there and the noise that went into it.
///
/// The next trace refreshes the histories there. Without records (models that give none) it is `ratio_noise_aware`.
std::unique_ptr<const Updater> make_path_reuse_updater();

/// The same for updaters that choose it.
Proposal reuse_paths(const DesignState& state, const DesignSpec& spec);

}  // namespace evenglow::design
