#pragma once

#include <optional>
#include <vector>

#include "core/light/stokes.h"
#include "core/montecarlo/photon_rng.h"
#include "tracer/films/prism_profile.h"
#include "tracer/geometry/ray_caster.h"

namespace evenglow::tests {

/// A prism film as an explicit mesh of quads in air, grooves along x, prisms up: the plain way, to check the fast one
/// against. Lengths are in pitches.
class PrismMesh {
 public:
  struct Shape {
    /// Upper border of one period, from valley (-0.5, 0) to valley (0.5, 0).
    std::vector<tracer::PrismPoint> border;
    double base = 1.7;  ///< from the flat face to the valleys
    double refractive_index = 1.58;
    int prisms = 800;
    double length = 2000.0;  ///< along the grooves
  };
  explicit PrismMesh(const Shape& shape);

  /// Light that meets the middle of the film at a random place of its period, until it leaves; empty: it met the rim.
  /// What the flat face reflects is brought back to the middle by whole periods.
  std::optional<core::StokesVector> trace(const core::StokesVector& incident, core::PhotonRng& rng) const;

  /// Borders of prisms with a flat tip (width 0: sharp), and with a tip rounded by an arc in `pieces` chords.
  static std::vector<tracer::PrismPoint> flat_border(double flat, double apex);
  static std::vector<tracer::PrismPoint> round_border(double radius, double apex, int pieces);

 private:
  tracer::RayHit next_hit(const core::Vec3& from, const core::Vec3& k, int skip, bool inside) const;

  Shape shape_;
  double top_ = 0.0;
  std::optional<tracer::RayCaster> caster_;
  std::vector<core::Vec3> normals_;
};

}  // namespace evenglow::tests
