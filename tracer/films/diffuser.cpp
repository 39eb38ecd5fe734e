#include "tracer/films/diffuser.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"

namespace evenglow::tracer {
namespace {

core::Vec3 mirrored(const core::Vec3& k) {
  return {k.x(), k.y(), -k.z()};
}

/// The unscattered light turned by the shortest way to `k_out`. Straight back, which only grazing light can do, any way
/// is as short; then the polarization is kept in the frame that `any` gives.
core::StokesVector turned(core::StokesVector light, const core::Vec3& k_out) {
  const core::Vec3 k = light.frame.k;
  const double denominator = 1.0 + k.dot(k_out);
  if (denominator < 1e-9) {
    light.frame = core::PolarizationFrame::any(k_out);
    return light;
  }
  const core::Vec3 e1 = light.frame.e1 - (k + k_out) * (light.frame.e1.dot(k_out) / denominator);
  // Of unit length but for rounding: one step of Newton's method in place of a root and a division.
  const core::Vec3 across = e1 - k_out * e1.dot(k_out);
  light.frame = {k_out, across * (1.5 - 0.5 * across.squaredNorm())};
  return light;
}

/// What a mirror of reflectance 1 makes of the light: identity in the tangential count, where both axes of the field
/// are mirrored too; that turns their handedness, so U and V, counted in a right-handed frame, change sign.
core::StokesVector mirror_image(const core::StokesVector& light) {
  return {light.I, light.Q, -light.U, -light.V, {mirrored(light.frame.k), mirrored(light.frame.e1)}};
}

}  // namespace

double Diffuser::lobe_width(double fwhm) {
  return std::sin(0.5 * fwhm) / std::sqrt(2.0 * std::log(2.0));
}

Diffuser::Diffuser(const Spec& spec) : spec_(spec) {
  const auto share = [](double x) { return x >= 0.0 && x <= 1.0; };
  core::expects(share(spec.transmittance) && share(spec.reflectance) && share(spec.haze) &&
                    share(spec.depolarization) && spec.transmittance + spec.reflectance <= 1.0 + 1e-12,
                "a diffuser's shares lie in [0, 1] and T + R is at most 1");
  core::expects(!spec.fwhm || !spec.abg, "a diffuser has one lobe");
  if (spec.fwhm) lobe_.emplace(lobe_width(*spec.fwhm));
  if (spec.abg) abg_.emplace(spec.abg->b, spec.abg->g);
}

Bsdf::Specular Diffuser::specular(const core::Vec3&) const {
  Specular s;
  s.transmission = spec_.transmittance * (1.0 - spec_.haze) * core::MuellerMatrix::Identity();
  return s;
}

std::optional<BsdfSample> Diffuser::sample(const core::StokesVector& incident, core::PhotonRng& rng) const {
  const double chance = rng.uniform();
  const core::Vec3& k = incident.frame.k;
  if (chance < spec_.transmittance * (1.0 - spec_.haze)) return BsdfSample{incident, true};
  if (chance < spec_.transmittance)
    return BsdfSample{scattered_light(incident, draw_direction(k, rng), spec_.depolarization), false};
  if (chance < spec_.transmittance + spec_.reflectance) {
    return BsdfSample{scattered_light(incident, draw_direction(mirrored(k), rng), spec_.depolarization), false};
  }
  return std::nullopt;
}

namespace {

/// A uniform point of the unit disk without its center: of the pair (a, b) and s = a^2 + b^2, (a, b) / sqrt(s) has a
/// uniform angle that does not depend on s, and s is uniform (Marsaglia & Bray, SIAM Review 6, 1964).
struct DiskPoint {
  double a = 0.0, b = 0.0, s = 1.0;

  explicit DiskPoint(core::PhotonRng& rng) {
    do {
      a = 2.0 * rng.uniform() - 1.0;
      b = 2.0 * rng.uniform() - 1.0;
      s = a * a + b * b;
    } while (s >= 1.0 || s == 0.0);
  }
};

}  // namespace

core::Vec3 Diffuser::draw_direction(const core::Vec3& unscattered, core::PhotonRng& rng) const {
  const double side = unscattered.z() >= 0.0 ? 1.0 : -1.0;
  while (true) {
    const DiskPoint point(rng);
    double bx = point.a, by = point.b;  // Lambert's law: uniform over the disk of direction cosines
    if (lobe_ || abg_) {
      // Box and Muller's way of the Gaussian over the point's own radius, by one root.
      const double per_radius = lobe_ ? lobe_->width() * std::sqrt(-2.0 * std::log(point.s) / point.s)
                                      : abg_->draw_way(rng) / std::sqrt(point.s);
      bx = unscattered.x() + per_radius * point.a;
      by = unscattered.y() + per_radius * point.b;
      const double beta2 = bx * bx + by * by;
      if (beta2 >= 1.0) continue;
      const double u = rng.uniform();
      if (lobe_ ? !lobe_->accepts(beta2, u) : u * abg_->largest_scaling() >= abg_->scaling(std::sqrt(beta2))) {
        continue;
      }
    }
    return {bx, by, side * std::sqrt(std::max(1.0 - bx * bx - by * by, 1e-18))};
  }
}

core::StokesVector scattered_light(const core::StokesVector& incident, const core::Vec3& k_out, double depolarization) {
  const bool through = (incident.frame.k.z() >= 0.0) == (k_out.z() >= 0.0);
  core::StokesVector light = turned(through ? incident : mirror_image(incident), k_out);
  const double kept = 1.0 - depolarization;
  light.Q *= kept;
  light.U *= kept;
  light.V *= kept;
  return light;
}

core::StokesVector Diffuser::evaluate(const core::StokesVector& incident, const core::Vec3& k_out) const {
  const core::Vec3& k = incident.frame.k;
  const bool through = (k.z() >= 0.0) == (k_out.z() >= 0.0);
  double f = through ? spec_.transmittance * spec_.haze : spec_.reflectance;
  if (lobe_ || abg_) {
    const double dx = k_out.x() - k.x();
    const double dy = k_out.y() - k.y();
    const double in = std::hypot(k.x(), k.y());
    const double out = std::hypot(k_out.x(), k_out.y());
    const double distance2 = dx * dx + dy * dy;
    f *= lobe_ ? lobe_->value(in, out, distance2) : abg_->value(in, out, distance2);
  } else {
    f /= core::kPi;
  }
  return scattered_light(incident, k_out, spec_.depolarization).scaled(f);
}

}  // namespace evenglow::tracer
