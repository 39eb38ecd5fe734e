#include "tracer/receivers/luminance_receiver.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {

LuminanceReceiver::LuminanceReceiver(const core::CellGrid& cells, double cone)
    : cells_(cells), sin_cone_(std::sin(cone)), weight_(1.0 / (core::kPi * sin_cone_ * sin_cone_)) {
  core::expects(cone > 0.0 && cone <= 0.5 * core::kPi + 1e-12, "0 < cone <= 90 degrees");
}

std::optional<Score> LuminanceReceiver::score(const Crossing& crossing) const {
  if (crossing.side != Side::kTop || crossing.estimated) return std::nullopt;
  const double sin2 = crossing.k.x() * crossing.k.x() + crossing.k.y() * crossing.k.y();
  if (sin2 > sin_cone_ * sin_cone_) return std::nullopt;
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
