#pragma once

#include <cmath>

#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// The pass axis of a film in the surface frame, and its angle psi = axis - azimuth from a ray's tangential direction
/// (configs/data/README.md; the same count for light from above and from below, since the film is taken to be the same
/// from both sides and the tangential count is that of the mirror image).
class FilmAxis {
 public:
  explicit FilmAxis(double axis) : cos_(std::cos(axis)), sin_(std::sin(axis)) {}

  double cos_psi(const TangentialFrame& ray) const { return cos_ * ray.azimuth_cos + sin_ * ray.azimuth_sin; }
  double sin_psi(const TangentialFrame& ray) const { return sin_ * ray.azimuth_cos - cos_ * ray.azimuth_sin; }

 private:
  double cos_, sin_;
};

}  // namespace evenglow::tracer
