#pragma once

#include <cstddef>
#include <cstdint>
#include <string>

#include "core/montecarlo/estimate.h"
#include "tracer/scene/density_field.h"
#include "tracer/scene/scene.h"
#include "tracer/transport/tracer.h"

namespace evenglow::tests {

/// Reads the map `backlight` of a run file, given in YAML's flow style without its braces:
/// `size: {length_mm: 20, width_mm: 10}, sources: [...]`. Throws `core::ConfigError` for every fault, unread keys
/// included.
tracer::BacklightSpec backlight_of(const std::string& flow_yaml);
tracer::Scene scene_of(const std::string& flow_yaml);

/// Shortest text that reads back as the same number, for YAML.
std::string text_of(double number);

/// A plate-free room of 2000 x 1000 mm whose four walls are ideal mirrors: films and a bottom that fill it see a world
/// without borders (the walls show mirror images of it). A film's axis must lie along x or y, or its image is another
/// film. So large that the 0.001 mm between area and walls are nothing. The map `reflectors` is left open: go on with
/// `, bottom: {...}}` or `}`.
extern const char* const kMirrorRoom;

struct TraceSetup {
  std::uint64_t photons = 100'000;
  std::uint64_t seed = 1;
  std::size_t batches = 100;
  int threads = 1;
  tracer::TracePath path = tracer::TracePath::kAuto;
};

/// A backlight and what a trace of it gave.
class Traced {
 public:
  Traced(const std::string& flow_yaml, const TraceSetup& setup);

  const tracer::Scene& scene() const { return scene_; }
  const tracer::TraceResult& result() const { return result_; }
  double photons() const { return static_cast<double>(result_.photons); }

  /// Photons that left by a side, that a part absorbed (all parts whose name begins so), that were lost.
  double escaped(tracer::Side side) const;
  double absorbed(const std::string& part) const;
  double lost() const;
  /// Photons that the energy account knows of; all of them, exactly.
  double accounted() const;

  /// cd/m2, with the standard error from the batches.
  core::Estimate mean_luminance() const;
  tracer::LuminanceMap map() const;

 private:
  tracer::Scene scene_;
  tracer::DensityField density_;
  tracer::TraceResult result_;
};

}  // namespace evenglow::tests
