#include "tracer/receivers/luminance_receiver.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/math/sampling.h"

namespace evenglow::tracer {

LuminanceReceiver::LuminanceReceiver(const core::CellGrid& cells, double cone, double polar, double azimuth)
    : cells_(cells),
      sin_cone_(std::sin(cone)),
      cos_cone_(std::cos(cone)),
      tilted_(polar > 0.0),
      side_(-std::sin(azimuth), std::cos(azimuth), 0.0),
      up_(-std::cos(polar) * std::cos(azimuth), -std::cos(polar) * std::sin(azimuth), std::sin(polar)),
      axis_(std::sin(polar) * std::cos(azimuth), std::sin(polar) * std::sin(azimuth), std::cos(polar)),
      weight_(1.0 / (core::kPi * sin_cone_ * sin_cone_)) {
  core::expects(cone > 0.0 && polar >= 0.0 && polar + cone <= 0.5 * core::kPi + 1e-12,
                "0 < cone <= 90 degrees, none of it below the horizon");
  if (tilted_) weight_ /= axis_.z();
}

bool LuminanceReceiver::sees(const core::Vec3& k) const {
  if (tilted_) return k.dot(axis_) >= cos_cone_;
  return k.x() * k.x() + k.y() * k.y() <= sin_cone_ * sin_cone_;
}

View LuminanceReceiver::sample_view(double u1, double u2) const {
  const core::Vec3 local = core::sample_cosine_cone(u1, u2, sin_cone_);
  if (!tilted_) return {local, 1.0};
  // Drawn with density k.a / (pi sin^2 cone), wanted with k_z over the projected solid angle.
  const core::Vec3 k = local.x() * side_ + local.y() * up_ + local.z() * axis_;
  return {k, k.z() / (local.z() * axis_.z())};
}

std::optional<Score> LuminanceReceiver::score(const Crossing& crossing) const {
  if (crossing.side != Side::kTop || crossing.estimated) return std::nullopt;
  if (!sees(crossing.k)) return std::nullopt;
  const int bin = cells_.index_at(crossing.position.x(), crossing.position.y());
  if (bin < 0) return std::nullopt;
  return Score{static_cast<std::size_t>(bin), weight_};
}

double luminance_per_score(const LuminanceReceiver& receiver, double flux, std::uint64_t photons) {
  return flux / static_cast<double>(photons) / receiver.cells().cell_area() * core::kCandelaPerM2;
}

LuminanceMap make_luminance_map(const LuminanceReceiver& receiver, const core::Tally& tally, double flux,
                                std::uint64_t photons) {
  const double factor = luminance_per_score(receiver, flux, photons);
  LuminanceMap map{{receiver.cells(), 0.0}, {receiver.cells(), 0.0}};
  for (std::size_t bin = 0; bin < tally.bins(); ++bin) {
    const core::Estimate total = tally.total(bin);
    map.luminance.values[bin] = factor * total.value;
    map.standard_error.values[bin] = factor * total.se;
  }
  return map;
}

}  // namespace evenglow::tracer
