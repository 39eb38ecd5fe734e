#include "core/base/error.h"
#include "design/updaters/noise_aware_ratio_updater.h"
#include "design/updaters/ratio_updater.h"
#include "design/updaters/updater.h"

namespace evenglow::design {

const std::vector<UpdaterEntry>& updater_registry() {
  static const std::vector<UpdaterEntry> entries = {
      {"ratio_noise_aware", "the ratio update on the response with its noise taken out band by band",
       make_noise_aware_ratio_updater},
      {"ratio", "density times a power of target over luminance", make_ratio_updater},
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
