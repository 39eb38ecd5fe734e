#pragma once

#include <memory>
#include <string>

#include "core/config/registry.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"

namespace evenglow::design {

/// What an updater proposes.
struct Proposal {
  tracer::DensityField density;  ///< within the limits of the spec
  double level_change = 1.0;     ///< factor of the mean density that was chosen for the level
  int clipped_low = 0;           ///< cells that the lower limit holds up
  int clipped_high = 0;          ///< cells that the upper limit holds down
};

/// Proposes the next density from a finished step; keeps no state of its own.
class Updater {
 public:
  virtual ~Updater() = default;
  virtual Proposal propose(const DesignState& state, const DesignSpec& spec) const = 0;
};

/// One line for each updater.
struct UpdaterEntry {
  std::string name;
  std::string help;
  std::unique_ptr<const Updater> (*make)();
};
const std::vector<UpdaterEntry>& updater_registry();
/// Throws Error for an unknown name.
std::unique_ptr<const Updater> make_updater(const std::string& name);

}  // namespace evenglow::design
