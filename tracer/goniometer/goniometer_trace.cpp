#include "tracer/goniometer/goniometer_trace.h"

#include <cmath>
#include <mutex>

#include "core/montecarlo/batches.h"
#include "core/montecarlo/photon_rng.h"
#include "core/montecarlo/tally.h"
#include "tracer/goniometer/goniometer_optics.h"

namespace evenglow::tracer {
namespace {

/// Hits of the photons of one batch.
std::vector<double> trace_batch(const GoniometerSpec& spec, const TracedSetting& setting, const core::RandomKey& key,
                                const core::BatchRange& range) {
  const GoniometerView view(spec, setting.psi);
  std::vector<core::Vec3> detectors;
  for (const ScatterKind kind : setting.kinds) {
    for (const double theta : spec.theta) detectors.push_back(view.direction(kind, 0.0, theta));
  }
  const core::StokesVector light = view.light(setting.kinds.front(), setting.filtered, setting.filter);
  const double least_cosine = std::cos(spec.acceptance);
  std::vector<double> hits(detectors.size(), 0.0);
  for (std::uint64_t i = range.first; i < range.first + range.count; ++i) {
    core::PhotonRng rng(key, i);
    const auto out = spec.film.surface->sample(light, rng);
    if (!out || out->specular) continue;
    const core::Vec3& k = out->light.frame.k;
    for (std::size_t d = 0; d < detectors.size(); ++d) {
      if (k.dot(detectors[d]) > least_cosine) ++hits[d];
    }
  }
  return hits;
}

}  // namespace

std::vector<TracedSetting> settings_of(const GoniometerSpec& spec) {
  const std::vector<ScatterKind> both{ScatterKind::reflection, ScatterKind::transmission};
  std::vector<TracedSetting> settings;
  for (const double psi : spec.psi) {
    settings.push_back({psi, false, 0.0, both, {}});
    for (const double filter : spec.filter.angles) {
      if (spec.offset_reflection == spec.offset_transmission) {
        settings.push_back({psi, true, filter, both, {}});
      } else {
        for (const ScatterKind kind : both) settings.push_back({psi, true, filter, {kind}, {}});
      }
    }
  }
  return settings;
}

bool trace_settings(const GoniometerSpec& spec, const GoniometerTrace& trace, std::vector<TracedSetting>& settings) {
  std::vector<std::vector<double>> results(settings.size() * trace.batches);
  std::mutex mutex;
  std::uint64_t done = 0;
  const bool whole = core::run_batches(
      results.size(), trace.threads,
      [&](std::size_t i) {
        const std::size_t setting = i / trace.batches;
        const auto range = core::batch_range(i % trace.batches, trace.batches, trace.photons);
        const core::RandomKey key{trace.seed, static_cast<std::uint32_t>(setting), 0};
        results[i] = trace_batch(spec, settings[setting], key, range);
        if (!trace.progress) return;
        const std::lock_guard lock(mutex);
        done += range.count;
        trace.progress(done);
      },
      trace.stop);
  if (!whole) return false;
  for (std::size_t s = 0; s < settings.size(); ++s) {
    core::Tally tally(results[s * trace.batches].size());
    for (std::size_t b = 0; b < trace.batches; ++b) tally.add_batch(std::move(results[s * trace.batches + b]));
    for (const core::Estimate& total : tally.totals()) settings[s].hits.push_back({total.value, total.se});
  }
  return true;
}

}  // namespace evenglow::tracer
