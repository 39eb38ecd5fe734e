#pragma once

#include "tracer/goniometer/goniometer.h"

namespace evenglow::tracer {

/// Hits of a detector, photons.
struct DetectorHits {
  double hits = 0.0;
  double hits_se = 0.0;  ///< from the batches
};

/// One trace: film at psi, one illumination; the detectors of `kinds` at every theta.
struct TracedSetting {
  double psi = 0.0;
  bool filtered = false;
  double filter = 0.0;
  std::vector<ScatterKind> kinds;
  std::vector<DetectorHits> hits;  ///< kind slowest, then theta; filled by `trace_settings`
};

/// Natural light is one trace for both kinds; so is filtered light, if the offsets are the same.
std::vector<TracedSetting> settings_of(const GoniometerSpec& spec);
/// False if it was stopped.
bool trace_settings(const GoniometerSpec& spec, const GoniometerTrace& trace, std::vector<TracedSetting>& settings);

}  // namespace evenglow::tracer
