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

double AngularSpot::area() const {
  return core::kPi * radius * radius;
}

std::optional<Score> AngularReceiver::spot_score(const Crossing& crossing) const {
  for (std::size_t i = 0; i < spots_.size(); ++i) {
    const double dx = crossing.position.x() - spots_[i].x;
    const double dy = crossing.position.y() - spots_[i].y;
    if (dx * dx + dy * dy > spots_[i].radius * spots_[i].radius) continue;
    auto result = score(crossing);
    if (result) result->bin += first_bin(i);
    return result;
  }
  return std::nullopt;
}

std::vector<AngularSpot> display_spots(const core::CellGrid& active_area, int count, double radius) {
  const double width = active_area.nx * active_area.dx;
  const double height = active_area.ny * active_area.dy;
  std::vector<AngularSpot> spots;
  const auto add = [&](std::initializer_list<double> shares) {
    for (const double v : shares) {
      for (const double u : shares) spots.push_back({active_area.x0 + u * width, active_area.y0 + v * height, radius});
    }
  };
  if (count == 1) add({0.5});
  if (count >= 9) add({0.1, 0.5, 0.9});
  if (count >= 13) add({0.3, 0.7});
  return spots;
}

double angular_luminance_per_photon(const AngularReceiver& receiver, int polar, double flux, std::uint64_t photons,
                                    double area) {
  return flux / static_cast<double>(photons) / (area * receiver.projected_solid_angle(polar)) * core::kCandelaPerM2;
}

std::vector<core::Estimate> make_angular_luminance(const AngularReceiver& receiver, const core::Tally& tally,
                                                   double flux, std::uint64_t photons, double area,
                                                   std::size_t first_bin) {
  std::vector<core::Estimate> result;
  for (std::size_t bin = 0; bin < receiver.directions(); ++bin) {
    const int polar = static_cast<int>(bin) / receiver.azimuth_count();
    const double factor = angular_luminance_per_photon(receiver, polar, flux, photons, area);
    const core::Estimate count = tally.total(first_bin + bin);
    result.push_back({factor * count.value, factor * count.se});
  }
  return result;
}

}  // namespace evenglow::tracer
