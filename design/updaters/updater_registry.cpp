#include "core/base/error.h"
#include "design/updaters/anderson_updater.h"
#include "design/updaters/auto_updater.h"
#include "design/updaters/coarse_newton_updater.h"
#include "design/updaters/gradient_updater.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "design/updaters/path_reuse_updater.h"
#include "design/updaters/ratio_updater.h"
#include "design/updaters/spline_updater.h"
#include "design/updaters/stochastic_approximation_updater.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

const std::vector<UpdaterEntry>& updater_registry() {
  static const std::vector<UpdaterEntry> entries = {
      {"auto", "chooses by measured coupling and noise", make_auto_updater},
      {"ratio_noise_aware", "the ratio update on the response with its noise taken out band by band",
       make_noise_aware_ratio_updater},
      {"path_reuse", "inner steps on re-weighted histories of the traces so far", make_path_reuse_updater},
      {"anderson", "Anderson acceleration of ratio_noise_aware in ln density", make_anderson_updater},
      {"coarse_newton", "the ratio update with a Gauss-Newton correction on a coarse grid", make_coarse_newton_updater},
      {"gradient", "NLopt's L-BFGS or MMA on the RMS of re-weighted histories", make_gradient_updater},
      {"ratio", "density times a power of target over luminance", make_ratio_updater},
      {"stochastic_approximation", "ratio steps whose gain falls cell by cell with each change of sign",
       make_stochastic_approximation_updater},
      {"spline", "a smooth profile with few coefficients, searched by NLopt", make_spline_updater},
  };
  return entries;
}

std::unique_ptr<const Updater> make_updater(const std::string& name) {
  for (const UpdaterEntry& entry : updater_registry()) {
    if (entry.name == name) return entry.make();
  }
  throw core::Error("unknown updater " + name);
}

}  // namespace evenglow::design
