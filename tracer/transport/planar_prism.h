#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>

#include "tracer/films/bef.h"
#include "tracer/transport/planar_light.h"

namespace evenglow::tracer {

/// A film of sharp prisms (`PrismFilm`) for light that is counted in the meridian frame. Same physics; what makes it
/// short: a turn about the normal, into the film's axes, leaves the meridian frame alone; each face counts the light in
/// the meridian frame of its own normal, and what leads from one face's frame to the next one's needs no root; and the
/// cross-section of a prism and that of the groove beside it are the same triangle.
///
/// Places: shares a, b >= 0, a + b <= 1, of the distances from the right and the left facet. In a prism a + b = 1 is
/// the level of the valleys, in a groove that of the tips; through the right facet (a = 0) b becomes 1 - b, through the
/// left one a becomes 1 - a.
class PlanarPrism {
 public:
  /// Empty for other films, and for prisms whose tips are flat or round.
  static std::optional<PlanarPrism> of(const Bsdf* optics);

  /// What becomes of light that meets the film: it leaves up or down (true), or is absorbed. `optical_depth`: what the
  /// photon has left to go until it is absorbed.
  template <typename Light>
  bool pass(Light& light, double& optical_depth, core::PhotonRng& rng) const;

 private:
  enum Face { kBase = 0, kRight = 1, kLeft = 2 };

  /// Light between two faces, in the film's axes: x along the grooves, z from the flat face to the prisms.
  struct Ray {
    double x = 0.0;           ///< k along the grooves
    double u = 0.0, v = 0.0;  ///< and along the normals of the right and the left facet, out of the film
    double a = 0.0, b = 0.0;  ///< the place
    bool inside = true;       ///< in a prism, else in a groove
    Face last = kBase;        ///< whose frame the light is counted in
    double component(Face face, double z) const { return face == kBase ? z : face == kRight ? u : v; }
  };
  enum class End { kNone, kLeft, kAbsorbed };

  explicit PlanarPrism(const PrismFilmSpec& spec);
  double z_of(const Ray& ray) const { return (ray.u + ray.v) * per_two_nz_; }
  template <typename Light>
  void turn_to(Face face, const Ray& ray, Light& light) const;
  template <typename Light>
  void meet_facet(Face face, Ray& ray, Light& light, core::PhotonRng& rng) const;
  template <typename Light>
  End visit_base(Ray& ray, double& z_out, Light& light, double& optical_depth, core::PhotonRng& rng) const;
  template <typename Light>
  void leave(const Ray& ray, double z, Light& light) const;

  double n_, per_n_;
  double ny_, nz_, per_two_ny_, per_two_nz_;              ///< of the right facet's normal
  double facets_dot_;                                     ///< of both normals
  std::array<std::array<double, 3>, 3> dot_{}, cross_{};  ///< of the faces' normals; x component of the cross product
  double scale_;                                          ///< mm: a = 1
  double pitch_share_per_mm_;                             ///< of a for one mm across the grooves
  double base_, absorption_;                              ///< mm, 1/mm
  double cos_, sin_, flip_;                               ///< of the axis; -1: inverted
};

template <typename Light>
void PlanarPrism::turn_to(Face face, const Ray& ray, Light& light) const {
  if (!light.is_polarized()) return;
  // s = n x k in both frames: s . s' = n . n' - (n . k)(n' . k), and k . (s x s') = k . (n x n').
  const double z = z_of(ray);
  const double c = dot_[ray.last][face] - ray.component(ray.last, z) * ray.component(face, z);
  const double s = ray.x * cross_[ray.last][face];
  const double norm = c * c + s * s;
  if (norm < 1e-30) return;
  const double inverse = 1.0 / norm;
  light.turn_frame((c * c - s * s) * inverse, 2.0 * c * s * inverse);
}

template <typename Light>
void PlanarPrism::meet_facet(Face face, Ray& ray, Light& light, core::PhotonRng& rng) const {
  turn_to(face, ray, light);
  ray.last = face;
  double& normal = face == kRight ? ray.u : ray.v;
  double& other = face == kRight ? ray.v : ray.u;
  const double ratio = ray.inside ? n_ : per_n_;
  const PlateFresnel fresnel(std::abs(normal), ratio);
  if (fresnel.total) light.turn_phase(fresnel.phase_re, fresnel.phase_im);
  if (fresnel.total || fresnel.reflects(light, rng)) {
    other -= 2.0 * normal * facets_dot_;
    normal = -normal;
    return;
  }
  fresnel.pass(light);
  const double refracted = std::copysign(fresnel.cos_t, normal);
  other = ratio * (other - normal * facets_dot_) + refracted * facets_dot_;
  normal = refracted;
  ray.x *= ratio;
  ray.inside = !ray.inside;
  double& along = face == kRight ? ray.b : ray.a;
  along = 1.0 - along;
}

/// From the level of the valleys to the flat face, and back up if it reflects the light.
template <typename Light>
PlanarPrism::End PlanarPrism::visit_base(Ray& ray, double& z_out, Light& light, double& optical_depth,
                                         core::PhotonRng& rng) const {
  const double z = z_of(ray);
  const double path = base_ / -z;
  optical_depth -= absorption_ * path;
  if (optical_depth <= 0.0) return End::kAbsorbed;
  turn_to(kBase, ray, light);
  ray.last = kBase;
  const PlateFresnel fresnel(-z, n_);
  if (fresnel.total) light.turn_phase(fresnel.phase_re, fresnel.phase_im);
  if (!fresnel.total && !fresnel.reflects(light, rng)) {
    fresnel.pass(light);
    z_out = -fresnel.cos_t;
    // y times the index stands in u - v.
    ray.x *= n_;
    const double y = n_ * (ray.u - ray.v) * per_two_ny_;
    ray.u = ny_ * y + nz_ * z_out;
    ray.v = nz_ * z_out - ny_ * y;
    return End::kLeft;
  }
  optical_depth -= absorption_ * path;
  const double y = (ray.u - ray.v) * per_two_ny_;
  const double u = -ray.v;
  ray.v = -ray.u;
  ray.u = u;
  const double a = ray.a - 2.0 * path * y * pitch_share_per_mm_;
  ray.a = a - std::floor(a);
  ray.b = 1.0 - ray.a;
  return optical_depth > 0.0 ? End::kNone : End::kAbsorbed;
}

/// Out of the film's axes.
template <typename Light>
void PlanarPrism::leave(const Ray& ray, double z, Light& light) const {
  const double y = flip_ * (ray.u - ray.v) * per_two_ny_;
  light.kx = cos_ * ray.x - sin_ * y;
  light.ky = sin_ * ray.x + cos_ * y;
  light.kz = flip_ * z;
  // Rounding of its length is taken out: no later reflection would.
  const double correction = 1.5 - 0.5 * (light.kx * light.kx + light.ky * light.ky + light.kz * light.kz);
  light.kx *= correction;
  light.ky *= correction;
  light.kz *= correction;
}

template <typename Light>
bool PlanarPrism::pass(Light& light, double& optical_depth, core::PhotonRng& rng) const {
  Ray ray;
  ray.x = cos_ * light.kx + sin_ * light.ky;
  double y = flip_ * (cos_ * light.ky - sin_ * light.kx);
  double z = flip_ * light.kz;
  ray.inside = z > 0.0;
  if (ray.inside) {
    const PlateFresnel fresnel(z, per_n_);
    if (fresnel.reflects(light, rng)) {
      light.kz = -light.kz;
      return true;
    }
    fresnel.pass(light);
    ray.x *= per_n_;
    y *= per_n_;
    z = fresnel.cos_t;
    optical_depth -= absorption_ * base_ / z;
  }
  ray.u = ny_ * y + nz_ * z;
  ray.v = nz_ * z - ny_ * y;
  ray.a = rng.uniform();
  ray.b = 1.0 - ray.a;
  for (int i = 0; i < PrismFilm::kMaxEvents; ++i) {
    // The triangle's edges that the ray runs against.
    const double p = ray.inside ? -ray.u : ray.u;
    const double q = ray.inside ? -ray.v : ray.v;
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const double to_right = p < 0.0 ? -ray.a / p : kNever;
    const double to_left = q < 0.0 ? -ray.b / q : kNever;
    const double to_open = p + q > 0.0 ? std::max(0.0, 1.0 - ray.a - ray.b) / (p + q) : kNever;
    const double way = std::min(std::min(to_right, to_left), to_open);
    if (ray.inside) {
      optical_depth -= absorption_ * scale_ * way;
      if (!(optical_depth > 0.0)) return false;
    }
    ray.a = std::max(0.0, ray.a + p * way);
    ray.b = std::max(0.0, ray.b + q * way);
    if (way == to_open) {
      if (!ray.inside) {
        turn_to(kBase, ray, light);
        leave(ray, z_of(ray), light);
        return true;
      }
      const End end = visit_base(ray, z, light, optical_depth, rng);
      if (end == End::kAbsorbed) return false;
      if (end == End::kNone) continue;
      leave(ray, z, light);
      return true;
    }
    if (to_right <= to_left) {
      ray.a = 0.0;
      meet_facet(kRight, ray, light, rng);
    } else {
      ray.b = 0.0;
      meet_facet(kLeft, ray, light, rng);
    }
  }
  return false;
}

}  // namespace evenglow::tracer
