#pragma once

#include <optional>

#include "core/light/stokes.h"
#include "core/math/vec3.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/microstructure/dot_grid.h"

namespace evenglow::tracer {

/// A shape with a height that is traced among the dots of a real pattern, each where it stands: what the optics of such
/// a shape are besides a Bsdf. (Ink has none: light meets it where its place is covered.)
///
/// Places and directions are those of the backlight, mm. A place is where the light's line crosses the plane of the
/// face; all is exact but for this: light is followed among the dots as if it had come along its line from far and went
/// on for as long, though a wall of the plate may stand within a height of the dots.
class DotShape {
 public:
  virtual ~DotShape() = default;

  /// Light and where its line crosses the face after it has met the dots.
  struct Outcome {
    core::StokesVector light;
    core::Vec2 place;
  };

  /// May light that comes along k to the face at this place meet a dot, with what the smooth face would make of it?
  /// Else the face is the smooth one for it.
  virtual bool meets_dot(const DotGrid& dots, const core::Vec2& place, const core::Vec3& k) const = 0;

  /// What becomes of it among the dots and on the bare face between them. Empty: absorbed (caught for too long).
  virtual std::optional<Outcome> sample_among(const DotGrid& dots, const core::Vec2& place,
                                              const core::StokesVector& light, core::PhotonRng& rng) const = 0;
};

}  // namespace evenglow::tracer
