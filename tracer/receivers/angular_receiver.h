#pragma once

#include <cstdint>
#include <vector>

#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// Light that leaves the top by direction: bins of polar angle (from the display's normal) and azimuth (from +x towards
/// +y), equal widths. Scores are counts of photons.
class AngularReceiver final : public Receiver {
 public:
  AngularReceiver(int polar_count, int azimuth_count) : polar_count_(polar_count), azimuth_count_(azimuth_count) {}

  std::size_t bins() const override {
    return static_cast<std::size_t>(polar_count_) * static_cast<std::size_t>(azimuth_count_);
  }
  std::optional<Score> score(const Crossing& crossing) const override;

  int polar_count() const { return polar_count_; }
  int azimuth_count() const { return azimuth_count_; }
  double polar_edge(int index) const;  ///< rad
  /// Integral of cos(theta) over the solid angle of a bin (sr).
  double projected_solid_angle(int polar) const;

 private:
  int polar_count_;
  int azimuth_count_;
};

/// Luminance of each bin averaged over `area` (mm2), cd/m2, index polar * azimuth_count + azimuth.
std::vector<core::Estimate> make_angular_luminance(const AngularReceiver& receiver, const core::Tally& tally,
                                                   double flux, std::uint64_t photons, double area);

}  // namespace evenglow::tracer
