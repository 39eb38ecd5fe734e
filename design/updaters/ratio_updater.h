#pragma once

#include "design/updaters/updater.h"

namespace evenglow::design {

/// Density times (target / luminance)^power, cell by cell, the ratio held in [1/4, 4]: the update that Zhdanov et al.
/// (Optical Review 21, 2014) describe, with the formula of its published family (US 7,277,609; Yan et al., Adv.
/// OptoElectronics 2016, 1760260). It follows the noise of the map.
std::unique_ptr<const Updater> make_ratio_updater();

}  // namespace evenglow::design
