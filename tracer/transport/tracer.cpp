#include "tracer/transport/tracer.h"

#include <algorithm>
#include <memory>
#include <mutex>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "tracer/transport/photon_history.h"
#include "tracer/transport/planar_history.h"
#include "tracer/transport/rank_sums.h"
#include "tracer/transport/recording_history.h"
#include "tracer/transport/trace_health.h"
#include "tracer/transport/wavefront_history.h"
#include "tracer/transport/wavefront_plate.h"

namespace evenglow::tracer {
namespace {

/// The layers, where the planar path is to be taken.
std::optional<PlanarScene> planar_layers(const Scene& scene, TracePath path) {
  if (path == TracePath::kGeneral) return std::nullopt;
  std::string reason;
  if (path == TracePath::kWavefront && !wavefront_serves(scene, &reason)) {
    throw core::Error(
        fmt::format("trace.path: wavefront is for counted luminance in a stack of parallel layers over a flat, clear "
                    "plate at one wavelength; this backlight is not of that kind: {}; allowed here: auto, planar, "
                    "general",
                    reason));
  }
  auto layers = PlanarScene::of(scene, &reason);
  if (!layers && path == TracePath::kPlanar) {
    throw core::Error(
        fmt::format("trace.path: planar is for parallel layers over a flat plate, and this backlight is not of that "
                    "kind: {}; allowed "
                    "here: auto, general",
                    reason));
  }
  return layers;
}

/// The photons of one batch; returns early when a stop is asked for.
template <typename History>
void run_range(const History& history, const TraceOptions& options, const core::BatchRange& range,
               const std::stop_token& stop, BatchSums& sums) {
  for (std::uint64_t i = 0; i < range.count; ++i) {
    // A long batch must not keep the user waiting after Ctrl-C.
    if (i % 256 == 0 && stop.stop_requested()) return;
    history.run(options.key, range.first + i, sums);
  }
}
void run_range(const WavefrontHistory& history, const TraceOptions& options, const core::BatchRange& range,
               const std::stop_token& stop, BatchSums& sums) {
  history.run(options.key, range, sums, stop);
}

/// The batches, empty if it was stopped.
template <typename History>
BatchResults traced_batches(const Scene& scene, const DensityField& density, const History& history,
                            const TraceOptions& options) {
  BatchResults sums(options.batches);
  std::mutex progress_mutex;
  std::uint64_t done = 0;
  core::RankGroup alone;
  core::RankGroup& ranks = options.ranks != nullptr ? *options.ranks : alone;
  const auto own = ranks.run_batches(
      options.batches, options.threads,
      [&](std::size_t batch, const std::stop_token& stop) {
        const core::BatchRange range = core::batch_range(batch, options.batches, options.photons);
        auto mine = std::make_unique<BatchSums>(scene);
        mine->viewer.seed(options.key, range.first);
        run_range(history, options, range, stop, *mine);
        if (stop.stop_requested()) return;
        sums[batch] = std::move(mine);
        const std::lock_guard lock(progress_mutex);
        done += range.count * static_cast<std::uint64_t>(ranks.count());  // the others are about as far
        if (options.progress) options.progress(std::min(done, options.photons));
      },
      options.stop, agreement_on(scene, density, options));
  if (!own) return {};
  share_sums(ranks, *own, scene, sums, options.stop);
  return sums;
}

TraceResult added(const Scene& scene, BatchResults sums, std::uint64_t photons) {
  TraceResult result{photons,
                     scene.flux,
                     core::Tally(scene.luminance.bins()),
                     core::Tally(scene.spec.color ? scene.luminance.bins() : 0),
                     core::Tally(scene.spec.color ? scene.luminance.bins() : 0),
                     core::Tally(scene.energy.bins()),
                     core::Tally(scene.angular ? scene.angular->bins() : 0),
                     0.0};
  for (auto& batch : sums) {
    result.luminance.add_batch(std::move(batch->luminance));
    result.color_x.add_batch(std::move(batch->color_x));
    result.color_z.add_batch(std::move(batch->color_z));
    result.energy.add_batch(std::move(batch->energy));
    result.angular.add_batch(std::move(batch->angular));
    result.events += batch->events[0];
  }
  return result;
}

template <typename History>
std::optional<TraceResult> traced(const Scene& scene, const DensityField& density, const History& history,
                                  const TraceOptions& options) {
  BatchResults sums = traced_batches(scene, density, history, options);
  if (sums.empty()) return std::nullopt;
  TraceResult result = added(scene, std::move(sums), options.photons);
  check_health(scene, result, options,
               [&](std::uint64_t photon, BatchSums& into) { history.run(options.key, photon, into); });
  return result;
}

/// With records beside the numbers.
template <typename History>
std::optional<TraceResult> recorded(const Scene& scene, const DensityField& density, const History& history,
                                    const TraceOptions& options) {
  RecordingHistory<History> recording(history, options.photons / options.batches, options.batches,
                                      options.record_bytes);
  auto result = traced(scene, density, recording, options);
  if (result) {
    result->records = std::make_shared<ArrivalRecords>(density, scene.luminance.cells().size(), options.threads,
                                                       recording.take_logs(), options.ranks, options.stop);
  }
  return result;
}

}  // namespace

bool takes_wavefront(const Scene& scene, const TraceOptions& options) {
  return options.path == TracePath::kWavefront && options.record_bytes == 0 && wavefront_serves(scene);
}

bool takes_planar_path(const Scene& scene, TracePath path) {
  return planar_layers(scene, path).has_value();
}

namespace {

TracePath path_of(const std::string& name) {
  if (name == "planar") return TracePath::kPlanar;
  if (name == "general") return TracePath::kGeneral;
  return name == "wavefront" ? TracePath::kWavefront : TracePath::kAuto;
}

}  // namespace

TraceSpec read_trace(const core::ConfigNode& node) {
  TraceSpec spec = read_photons(node);
  const std::string path =
      node.choice({"path",
                   "how flights are found: in closed form between parallel layers (planar), the same for many "
                   "photons at once (wavefront), by ray tracing (general), or planar where the backlight allows it "
                   "(auto)",
                   {"auto", "planar", "general", "wavefront"},
                   "auto"});
  spec.path = path_of(path);
  return spec;
}

TraceSpec read_photons(const core::ConfigNode& node) {
  TraceSpec spec;
  spec.photons = static_cast<std::uint64_t>(node.count(
      {"photons", "photons of the final trace, and of the largest design step", 1000, 1'000'000'000'000, 20'000'000}));
  spec.seed = static_cast<std::uint64_t>(
      node.integer({"seed", "seed of the random numbers", 0, std::numeric_limits<long long>::max(), 1}));
  spec.batches = static_cast<std::size_t>(
      node.integer({"batches", "equal parts of a trace, from whose spread the standard errors come", 10, 1000, 100}));
  spec.photons = whole_batches(spec.photons, spec.batches);
  return spec;
}

std::uint64_t whole_batches(std::uint64_t photons, std::size_t batches) {
  return (photons + batches - 1) / batches * batches;
}

std::optional<TraceResult> trace(const Scene& scene, const DensityField& density, const TraceOptions& options) {
  const auto layers = planar_layers(scene, options.path);
  const std::size_t most = ArrivalLog::kMostIndex;
  const bool by_dots = density.dots != nullptr;
  const bool record =
      !by_dots && options.record_bytes > 0 && scene.luminance.bins() <= most && density.cells.values.size() <= most;
  if (layers && by_dots) return traced(scene, density, DotPlanarHistory(scene, *layers, density), options);
  if (takes_wavefront(scene, options))
    return traced(scene, density, WavefrontHistory(scene, *layers, density), options);
  if (layers && record) return recorded(scene, density, PlanarRecordingHistory(scene, *layers, density), options);
  if (layers) return traced(scene, density, PlanarHistory(scene, *layers, density), options);
  if (record) return recorded(scene, density, PhotonHistory(scene, density), options);
  return traced(scene, density, PhotonHistory(scene, density), options);
}

}  // namespace evenglow::tracer
