#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stop_token>

#include "core/config/config_node.h"
#include "core/montecarlo/photon_rng.h"
#include "core/montecarlo/tally.h"
#include "core/parallel/ranks.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/arrival_records.h"

namespace evenglow::tracer {

/// How flights are found. `kPlanar`: in closed form, for a stack of parallel layers (`PlanarScene`); `kGeneral`: by ray
/// tracing, for any scene; `kWavefront`: as planar, many photons at once (`WavefrontHistory`); `kAuto`: the fastest
/// that the scene allows. The physics is the same.
enum class TracePath { kAuto, kPlanar, kGeneral, kWavefront };

/// How a backlight is traced; the map `trace` of the run file.
struct TraceSpec {
  std::uint64_t photons = 20'000'000;  ///< of a trace that judges; rounded up to a multiple of `batches`
  std::uint64_t seed = 1;
  std::size_t batches = 100;  ///< realizations from which the standard errors come
  TracePath path = TracePath::kAuto;
};

TraceSpec read_trace(const core::ConfigNode& trace);
/// The same but for `path`, for what is no backlight.
TraceSpec read_photons(const core::ConfigNode& trace);

/// The numbers of one trace: a Tally for each receiver.
struct TraceResult {
  std::uint64_t photons = 0;
  double flux = 0.0;      ///< lm that the photons share
  core::Tally luminance;  ///< scores, 1/sr, of each direction of view (view_sums.h)
  core::Tally color_x;    ///< as luminance, for the tristimulus values X and Z; no bins unless the color is asked for
  core::Tally color_z;
  core::Tally energy;                               ///< photons
  core::Tally angular;                              ///< photons
  double events = 0.0;                              ///< surface interactions in all
  std::shared_ptr<const ArrivalRecords> records{};  ///< if they were asked for
};

/// Photons done so far; called from any thread, one call at a time.
using TraceProgress = std::function<void(std::uint64_t)>;

struct TraceOptions {
  std::uint64_t photons = 0;  ///< a multiple of `batches`
  std::size_t batches = 100;
  core::RandomKey key;
  int threads = 0;  ///< 0: all
  std::stop_token stop{};
  TraceProgress progress{};
  TracePath path = TracePath::kAuto;
  /// Bytes for records of histories (`ArrivalRecords`), of the first photons of each batch; 0: none. The numbers of the
  /// trace are the same with and without.
  std::size_t record_bytes = 0;
  core::RankGroup* ranks = nullptr;  ///< that share the batches; null: this process alone
};

/// The next multiple of `batches` that is not less than `photons`.
std::uint64_t whole_batches(std::uint64_t photons, std::size_t batches);

/// Is this scene traced by the wavefront? Records of histories and what `wavefront_serves` refuses are left to the
/// planar path.
bool takes_wavefront(const Scene& scene, const TraceOptions& options);

/// Is this scene traced by the planar path? Throws Error if that was asked for and cannot be.
bool takes_planar_path(const Scene& scene, TracePath path);

/// Traces all photons. A density with dots is traced dot by dot, by the planar or the general path, and keeps no
/// records. Empty if it was stopped. Throws Error if photons were lost or a sum is no power
/// (trace_health.h), or if the planar path is asked for and the scene is no stack of parallel layers.
std::optional<TraceResult> trace(const Scene& scene, const DensityField& density, const TraceOptions& options);

}  // namespace evenglow::tracer
