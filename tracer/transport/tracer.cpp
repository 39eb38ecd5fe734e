#include "tracer/transport/tracer.h"

#include <memory>
#include <mutex>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/montecarlo/batches.h"
#include "tracer/transport/photon_history.h"

namespace evenglow::tracer {
namespace {

constexpr double kLostAllowed = 1e-6;
constexpr double kLostAlwaysAllowed = 10.0;

void check_lost(const Scene& scene, const TraceResult& result) {
  static constexpr const char* kReasons[] = {"leaked", "stuck", "invalid"};
  double lost = 0.0;
  std::string text;
  for (int i = 0; i < kLossReasons; ++i) {
    const double count = result.energy.total(scene.energy.lost_bin(static_cast<LossReason>(i))).value;
    lost += count;
    text += fmt::format("{}{} {}", i > 0 ? ", " : "", count, kReasons[i]);
  }
  if (lost > kLostAlwaysAllowed && lost > kLostAllowed * static_cast<double>(result.photons)) {
    throw core::Error(fmt::format("too many photons were lost: {} of {} ({})", lost, result.photons, text));
  }
}

}  // namespace

TraceSpec read_trace(const core::ConfigNode& node) {
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
  std::vector<std::unique_ptr<BatchSums>> sums(options.batches);
  const PhotonHistory history(scene, density);
  std::mutex progress_mutex;
  std::uint64_t done = 0;
  const bool complete = core::run_batches(
      options.batches, options.threads,
      [&](std::size_t batch) {
        const core::BatchRange range = core::batch_range(batch, options.batches, options.photons);
        auto mine = std::make_unique<BatchSums>(scene);
        for (std::uint64_t i = 0; i < range.count; ++i) {
          // A long batch must not keep the user waiting after Ctrl-C.
          if (i % 4096 == 0 && options.stop.stop_requested()) return;
          history.run(options.key, range.first + i, *mine);
        }
        sums[batch] = std::move(mine);
        const std::lock_guard lock(progress_mutex);
        done += range.count;
        if (options.progress) options.progress(done);
      },
      options.stop);
  if (!complete || options.stop.stop_requested()) return std::nullopt;
  TraceResult result{options.photons,
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
  check_lost(scene, result);
  return result;
}

}  // namespace evenglow::tracer
