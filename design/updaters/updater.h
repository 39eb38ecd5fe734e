#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/config/registry.h"
#include "design/problem/design_spec.h"
#include "design/problem/design_state.h"

namespace evenglow::design {

/// What an updater proposes.
struct Proposal {
  tracer::DensityField density;          ///< within the limits of the spec
  double level_change = 1.0;             ///< factor of the mean density that was chosen for the level
  int clipped_low = 0;                   ///< cells that the lower limit holds up
  int clipped_high = 0;                  ///< cells that the upper limit holds down
  std::optional<double> foreseen_rms{};  ///< RMS that the updater expects of it, noise taken off; none: it cannot tell
  bool solved = false;                   ///< the traces so far tell of no better density than this
  std::optional<double> noise_left{};    ///< RMS of the traces' noise that went into it; none: not known
  std::string method;                    ///< of an updater that chooses among several: the one it took
  std::string note;                      ///< for the log, where the updater has changed its mind; else empty
};

/// What an updater keeps from step to step: named lists of numbers. It belongs to the progress of the design and is
/// saved with it, so that a design goes on from a checkpoint to the same bits.
using UpdaterMemory = std::map<std::string, std::vector<double>>;

/// Proposes the next density from a finished step, whose luminance is over the target (target.h); keeps no state of its
/// own but in the memory that it is handed.
class Updater {
 public:
  virtual ~Updater() = default;
  virtual Proposal propose(const DesignState& state, const DesignSpec& spec, UpdaterMemory& memory) const = 0;
  /// Steps without gain after which the design counts as stalled: searches that try need more than updates that aim.
  virtual int patience(const DesignSpec&) const { return 4; }
  /// Does it make use of the histories of the photons (`DesignState::recorded`)?
  virtual bool wants_records() const { return false; }
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
