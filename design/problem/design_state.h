#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "core/montecarlo/tally.h"
#include "design/problem/judgment.h"
#include "tracer/receivers/luminance_receiver.h"
#include "tracer/scene/density_field.h"

namespace evenglow::tracer {
class ArrivalRecords;
}

namespace evenglow::design {

/// The display as one of several directions of view shows it.
struct ViewedLuminance {
  double polar_deg = 0.0, azimuth_deg = 0.0;
  double share = 0.0;     ///< of what counts
  core::Tally luminance;  ///< as `Observation::luminance`
};

/// What one trace of a backlight shows.
struct Observation {
  std::uint64_t photons = 0;
  tracer::LuminanceMap map;                ///< cd/m2, active area
  core::Tally luminance;                   ///< the batches that the map was made of, any unit proportional to cd/m2
  double luminance_unit = 1.0;             ///< cd/m2 for 1 of `luminance`
  std::vector<ViewedLuminance> views;      ///< of several directions of view, whose sum `luminance` is; else empty
  core::Estimate efficiency;               ///< share of the source flux that leaves the top
  std::vector<double> efficiency_batches;  ///< the same of each batch, for errors of differences; may be empty
  EnergyAccount energy;
  std::optional<AngularLuminance> angular;
  std::vector<SpotLuminance> angular_spots;  ///< of single spots, if asked for
  core::Tally color_x;  ///< tristimulus values beside `luminance` (which is Y), in its unit; no bins without color
  core::Tally color_z;
  double cpu_s = 0.0;
  double wall_s = 0.0;
  std::shared_ptr<const tracer::ArrivalRecords> records{};  ///< histories of its photons, if they were asked for
};

/// A trace whose histories are kept.
struct RecordedTrace {
  std::shared_ptr<const tracer::ArrivalRecords> records;
  core::Tally luminance;  ///< of all its photons, as traced
  std::uint64_t photons = 0;
  std::uint32_t step = 0;     ///< whose random numbers it had
  core::CellField density{};  ///< that was traced, on the cells of the design
};

/// One step of a design: a density and what it showed.
struct DesignState {
  tracer::DensityField density;
  Observation observation;
  StepRecord record{};                    ///< how it is judged
  std::vector<RecordedTrace> recorded{};  ///< of this step (last) and earlier ones, for updaters that want records
};

/// From a density to an observation, with `photons` photons and the random numbers of `step`. Empty: interrupted.
struct ForwardModel : std::function<std::optional<Observation>(const tracer::DensityField& density,
                                                               std::uint64_t photons, std::uint32_t step)> {
  using function::function;
  /// The same with records of the histories in the observation; null: this model has none.
  function recording{};
};

}  // namespace evenglow::design
