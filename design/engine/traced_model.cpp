#include "design/engine/traced_model.h"

#include <chrono>
#include <cmath>
#include <utility>
#include <vector>

#include <fmt/core.h>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/montecarlo/batches.h"
#include "design/problem/half_angles.h"
#include "tracer/receivers/view_sums.h"
#include "tracer/scene/refined_density.h"

namespace evenglow::design {
namespace {

/// All that the account holds: the photons, or, where they carry different luminous flux, what they carried in fact.
double accounted(const tracer::TraceResult& result) {
  double sum = 0.0;
  for (const core::Estimate& bin : result.energy.totals()) sum += bin.value;
  return sum;
}

core::Estimate share(const tracer::TraceResult& result, std::size_t bin, double whole) {
  const core::Estimate count = result.energy.total(bin);
  return {count.value / whole, count.se / whole};
}

/// The share that leaves the top, batch by batch.
std::vector<double> efficiency_batches(const tracer::TraceResult& result) {
  const double whole = accounted(result) / static_cast<double>(result.energy.batches());
  std::vector<double> shares;
  for (std::size_t b = 0; b < result.energy.batches(); ++b)
    shares.push_back(result.energy.batch(b)[static_cast<std::size_t>(tracer::Side::kTop)] / whole);
  return shares;
}

EnergyAccount energy_account(const tracer::Scene& scene, const tracer::TraceResult& result) {
  EnergyAccount account;
  const double whole = accounted(result);
  account.emitted_lm = result.flux;
  for (int i = 0; i < tracer::kSides; ++i) {
    account.escaped.push_back(
        {side_name(static_cast<tracer::Side>(i)), share(result, static_cast<std::size_t>(i), whole)});
  }
  const auto& parts = scene.energy.parts();
  for (std::size_t i = 0; i < parts.size(); ++i) {
    account.absorbed.push_back({parts[i], share(result, scene.energy.absorbed_bin(static_cast<int>(i)), whole)});
  }
  std::vector<double> lost(result.energy.bins(), 0.0);
  for (int i = 0; i < tracer::kLossReasons; ++i) lost[scene.energy.lost_bin(static_cast<tracer::LossReason>(i))] = 1.0;
  const core::Estimate total = result.energy.weighted_total(lost);
  account.lost = {total.value / whole, total.se / whole};
  return account;
}

/// Do photons carry different luminous flux? Only where several bands share them out by color as well (SpectralBands).
bool flux_varies(const tracer::Scene& scene) {
  return scene.spec.color && scene.bands.size() > 1;
}

void check_energy(const tracer::Scene& scene, const tracer::TraceResult& result, std::uint32_t step) {
  const core::Estimate sum = result.energy.weighted_total(std::vector<double>(result.energy.bins(), 1.0));
  if (energy_adds_up(sum, result.photons, flux_varies(scene))) return;
  throw core::Error(fmt::format("the energy account of step {} holds {} of {} photons: light was lost or made", step,
                                sum.value, result.photons));
}

/// Of the whole area (first bin 0) or of a spot.
AngularLuminance angular_luminance(const tracer::Scene& scene, const tracer::TraceResult& result, double area,
                                   std::size_t first_bin) {
  const tracer::AngularReceiver& receiver = *scene.angular;
  AngularLuminance angular;
  for (int i = 0; i <= receiver.polar_count(); ++i) angular.polar_deg.push_back(90.0 * i / receiver.polar_count());
  angular.azimuth_count = receiver.azimuth_count();
  angular.luminance = make_angular_luminance(receiver, result.angular, result.flux, result.photons, area, first_bin);
  DirectionBins bins{first_bin, receiver.azimuth_count(), {}};
  for (int i = 0; i < receiver.polar_count(); ++i) {
    bins.ring_unit.push_back(angular_luminance_per_photon(receiver, i, result.flux, result.photons, area));
  }
  angular.horizontal = half_angles(result.angular, bins, 0.0);
  angular.vertical = half_angles(result.angular, bins, 90.0);
  return angular;
}

void add_angular(const tracer::Scene& scene, const tracer::TraceResult& result, Observation& observation) {
  const core::Vec3 size = scene.box.max - scene.box.min;
  observation.angular = angular_luminance(scene, result, size.x() * size.y(), 0);
  for (std::size_t i = 0; i < scene.angular->spots().size(); ++i) {
    const tracer::AngularSpot& spot = scene.angular->spots()[i];
    observation.angular_spots.push_back({spot.x, spot.y, 2.0 * spot.radius,
                                         angular_luminance(scene, result, spot.area(), scene.angular->first_bin(i))});
  }
}

/// What counts of several directions of view, and each of them.
void add_luminance(const tracer::Scene& scene, const tracer::TraceResult& result, Observation& observation) {
  const std::size_t cells = scene.luminance.cells().size();
  observation.luminance = tracer::sum_of_directions(result.luminance, cells);
  observation.map = make_luminance_map(scene.luminance, observation.luminance, result.flux, result.photons);
  observation.luminance_unit = luminance_per_score(scene.luminance, result.flux, result.photons);
  if (result.color_x.bins() > 0) {
    observation.color_x = tracer::sum_of_directions(result.color_x, cells);
    observation.color_z = tracer::sum_of_directions(result.color_z, cells);
  }
  const std::vector<tracer::ViewDirection>& views = scene.spec.luminance.views;
  for (std::size_t i = 0; i < views.size(); ++i) {
    observation.views.push_back({views[i].polar / core::kRadPerDeg, views[i].azimuth / core::kRadPerDeg, views[i].share,
                                 tracer::one_direction(result.luminance, cells, i, views[i].share)});
  }
}

double cpu_of_all(const TracedModelOptions& options) {
  return core::process_cpu_seconds() + (options.ranks != nullptr ? options.ranks->others_cpu_s() : 0.0);
}

/// One trace; `record_bytes` 0: without records.
std::optional<Observation> observe(const tracer::Scene& scene, const TracedModelOptions& options,
                                   std::size_t record_bytes, const tracer::DensityField& density, std::uint64_t photons,
                                   std::uint32_t step) {
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_of_all(options);
  tracer::TraceOptions run;
  run.photons = tracer::whole_batches(photons, options.batches);
  run.batches = options.batches;
  run.key = {options.seed, options.stream, step};
  run.threads = options.threads;
  run.stop = options.stop;
  run.path = options.path;
  run.record_bytes = record_bytes;
  run.ranks = options.ranks;
  if (options.progress) run.progress = [&](std::uint64_t done) { options.progress(done, run.photons); };
  const auto result = trace(scene, traced_density(scene.spec, density), run);
  if (!result) return std::nullopt;
  check_energy(scene, *result, step);
  Observation observation = make_observation(scene, *result);
  observation.records = result->records;
  observation.cpu_s = cpu_of_all(options) - cpu;
  observation.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  return observation;
}

}  // namespace

bool energy_adds_up(const core::Estimate& sum, std::uint64_t photons, bool flux_varies) {
  constexpr double kRounding = 1e-9;
  constexpr double kDeviations = 20.0;  // of few batches: the spread is itself known from few numbers
  const double sent = static_cast<double>(photons);
  // Without chance in it the error is that of photons that were lost: it must not excuse them.
  return std::abs(sum.value - sent) <= kRounding * sent + (flux_varies ? kDeviations * sum.se : 0.0);
}

Observation make_observation(const tracer::Scene& scene, const tracer::TraceResult& result) {
  Observation observation;
  observation.photons = result.photons;
  add_luminance(scene, result, observation);
  observation.energy = energy_account(scene, result);
  observation.efficiency = observation.energy.escaped[static_cast<std::size_t>(tracer::Side::kTop)].share;
  observation.efficiency_batches = efficiency_batches(result);
  if (scene.angular) add_angular(scene, result, observation);
  return observation;
}

ForwardModel traced_model(const tracer::Scene& scene, TracedModelOptions options) {
  const auto with_bytes = [&](std::size_t bytes) {
    return [&scene, options, bytes](const tracer::DensityField& density, std::uint64_t photons, std::uint32_t step) {
      return observe(scene, options, bytes, density, photons, step);
    };
  };
  ForwardModel model = with_bytes(0);
  model.recording = with_bytes(options.record_bytes);
  return model;
}

}  // namespace evenglow::design
