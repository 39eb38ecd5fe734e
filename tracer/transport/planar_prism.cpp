#include "tracer/transport/planar_prism.h"

namespace evenglow::tracer {

PlanarPrism::PlanarPrism(const PrismFilmSpec& spec)
    : n_(spec.refractive_index),
      per_n_(1.0 / spec.refractive_index),
      ny_(std::cos(0.5 * spec.profile.apex)),
      nz_(std::sin(0.5 * spec.profile.apex)),
      per_two_ny_(0.5 / ny_),
      per_two_nz_(0.5 / nz_),
      facets_dot_(nz_ * nz_ - ny_ * ny_),
      scale_(spec.profile.pitch * ny_),
      pitch_share_per_mm_(1.0 / spec.profile.pitch),
      base_(spec.base),
      absorption_(spec.absorption),
      cos_(std::cos(spec.axis)),
      sin_(std::sin(spec.axis)),
      flip_(spec.inverted ? -1.0 : 1.0) {
  dot_ = {{{1.0, nz_, nz_}, {nz_, 1.0, facets_dot_}, {nz_, facets_dot_, 1.0}}};
  const double facets = 2.0 * ny_ * nz_;
  cross_ = {{{0.0, -ny_, ny_}, {ny_, 0.0, facets}, {-ny_, -facets, 0.0}}};
}

std::optional<PlanarPrism> PlanarPrism::of(const Bsdf* optics) {
  const auto* film = dynamic_cast<const PrismFilm*>(optics);
  if (film == nullptr || film->spec().profile.tip_flat > 0.0 || film->spec().profile.tip_radius > 0.0) {
    return std::nullopt;
  }
  return PlanarPrism(film->spec());
}

}  // namespace evenglow::tracer
