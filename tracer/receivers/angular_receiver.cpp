#include "tracer/receivers/angular_receiver.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"

namespace evenglow::tracer {

std::optional<Score> AngularReceiver::score(const Crossing& crossing) const {
  if (crossing.side != Side::kTop) return std::nullopt;
  const double polar = std::acos(std::clamp(crossing.k.z(), 0.0, 1.0));
  double azimuth = std::atan2(crossing.k.y(), crossing.k.x());
  if (azimuth < 0.0) azimuth += 2.0 * core::kPi;
  const int i = std::min(static_cast<int>(polar / (0.5 * core::kPi) * polar_count_), polar_count_ - 1);
  const int j = std::min(static_cast<int>(azimuth / (2.0 * core::kPi) * azimuth_count_), azimuth_count_ - 1);
  return Score{static_cast<std::size_t>(i * azimuth_count_ + j), 1.0};
}

double AngularReceiver::polar_edge(int index) const {
  return 0.5 * core::kPi * index / polar_count_;
}

double AngularReceiver::projected_solid_angle(int polar) const {
  const double s0 = std::sin(polar_edge(polar));
  const double s1 = std::sin(polar_edge(polar + 1));
  return core::kPi * (s1 * s1 - s0 * s0) / azimuth_count_;
}

std::vector<core::Estimate> make_angular_luminance(const AngularReceiver& receiver, const core::Tally& tally,
                                                   double flux, std::uint64_t photons, double area) {
  std::vector<core::Estimate> result;
  for (std::size_t bin = 0; bin < tally.bins(); ++bin) {
    const int polar = static_cast<int>(bin) / receiver.azimuth_count();
    const double factor =
        flux / static_cast<double>(photons) / (area * receiver.projected_solid_angle(polar)) * core::kCandelaPerM2;
    const core::Estimate count = tally.total(bin);
    result.push_back({factor * count.value, factor * count.se});
  }
  return result;
}

}  // namespace evenglow::tracer
