#pragma once

#include "tracer/films/diffuser.h"
#include "tracer/transport/planar_light.h"

namespace evenglow::tracer {

/// The light turned by the shortest way to the direction `to` (unit), as `scattered_light` does it: the angle between
/// the meridian frame that is carried along and that of `to`. With h, h' the horizontal parts of both directions,
/// c = k . k', t = z . (h x h') and the turn R v = v - (k + k') (v . k') / (1 + c) of vectors normal to k: the cosine
/// of the angle, s' . R s with s = z x k, is as h . h' (1 + c) + t^2, its sine, e1' . R s, as t (k_z + k'_z). False,
/// and nothing done, where a meridian frame or the shortest way is not defined.
template <typename Light>
bool carry_to(const core::Vec3& to, Light& light) {
  const double sin2_from = light.kx * light.kx + light.ky * light.ky;
  const double sin2_to = to.x() * to.x() + to.y() * to.y();
  const double dot = light.kx * to.x() + light.ky * to.y();
  const double cosine = dot + light.kz * to.z();
  if (light.is_polarized()) {
    if (sin2_from < 1e-18 || sin2_to < 1e-18 || cosine < -1.0 + 1e-9) return false;
    const double t = light.kx * to.y() - light.ky * to.x();
    const double c = dot * (1.0 + cosine) + t * t;
    const double s = t * (light.kz + to.z());
    const double inverse = 1.0 / (c * c + s * s);
    light.turn_frame((c * c - s * s) * inverse, 2.0 * c * s * inverse);
  }
  light.kx = to.x();
  light.ky = to.y();
  light.kz = to.z();
  return true;
}

/// What became of light at a diffuser.
enum class DiffuserEnd { kStraight, kScattered, kAbsorbed };

/// `Diffuser::sample` for light that is counted in the meridian frame.
template <typename Light>
DiffuserEnd pass_diffuser(const Diffuser& diffuser, Light& light, core::PhotonRng& rng) {
  const Diffuser::Spec& spec = diffuser.spec();
  const double chance = rng.uniform();
  if (chance < spec.transmittance * (1.0 - spec.haze)) return DiffuserEnd::kStraight;
  if (chance >= spec.transmittance + spec.reflectance) return DiffuserEnd::kAbsorbed;
  if (chance >= spec.transmittance) {
    light.mirror();
    light.kz = -light.kz;
  }
  const core::Vec3 to = diffuser.draw_direction({light.kx, light.ky, light.kz}, rng);
  if (carry_to(to, light)) {
    light.depolarize(1.0 - spec.depolarization);
  } else {
    light = Light(scattered_light(light.stokes(), to, spec.depolarization));
  }
  return DiffuserEnd::kScattered;
}

}  // namespace evenglow::tracer
