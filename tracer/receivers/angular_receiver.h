#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "core/math/cell_field.h"
#include "core/montecarlo/tally.h"
#include "tracer/receivers/receiver.h"

namespace evenglow::tracer {

/// A disc of the display whose light is also counted apart.
struct AngularSpot {
  double x = 0.0, y = 0.0;  ///< center, mm
  double radius = 0.0;      ///< mm

  double area() const;  ///< mm2
};

/// Light that leaves the top by direction: bins of polar angle (from the display's normal) and azimuth (from +x towards
/// +y), equal widths. Scores are counts of photons. First the bins of the whole area, then those of each spot.
class AngularReceiver final : public Receiver {
 public:
  /// The spots must lie within the display and not overlap.
  AngularReceiver(int polar_count, int azimuth_count, std::vector<AngularSpot> spots = {})
      : polar_count_(polar_count), azimuth_count_(azimuth_count), spots_(std::move(spots)) {}

  std::size_t bins() const override { return directions() * (1 + spots_.size()); }
  std::optional<Score> score(const Crossing& crossing) const override;
  /// The bin of the spot that the light leaves from; none: from between the spots.
  std::optional<Score> spot_score(const Crossing& crossing) const;

  /// Bins of the whole area, and of each spot.
  std::size_t directions() const {
    return static_cast<std::size_t>(polar_count_) * static_cast<std::size_t>(azimuth_count_);
  }
  const std::vector<AngularSpot>& spots() const { return spots_; }
  /// First bin of a spot.
  std::size_t first_bin(std::size_t spot) const { return directions() * (1 + spot); }

  int polar_count() const { return polar_count_; }
  int azimuth_count() const { return azimuth_count_; }
  double polar_edge(int index) const;  ///< rad
  /// Integral of cos(theta) over the solid angle of a bin (sr).
  double projected_solid_angle(int polar) const;

 private:
  int polar_count_;
  int azimuth_count_;
  std::vector<AngularSpot> spots_;
};

/// The spots of the 9 points (10, 50 and 90 % of length and width), or, for `count` 13, also of the four at 30 and 70
/// %; 1: the center alone. The order is that of y, then x, the four last.
std::vector<AngularSpot> display_spots(const core::CellGrid& active_area, int count, double radius);

/// cd/m2 for one photon of `flux` / `photons` lm in a bin of this polar index, averaged over `area` (mm2).
double angular_luminance_per_photon(const AngularReceiver& receiver, int polar, double flux, std::uint64_t photons,
                                    double area);

/// Luminance of each direction averaged over `area` (mm2), cd/m2, index polar * azimuth_count + azimuth. `first_bin`: 0
/// for the whole area, or that of a spot.
std::vector<core::Estimate> make_angular_luminance(const AngularReceiver& receiver, const core::Tally& tally,
                                                   double flux, std::uint64_t photons, double area,
                                                   std::size_t first_bin = 0);

}  // namespace evenglow::tracer
