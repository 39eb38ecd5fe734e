#pragma once

#include <cmath>
#include <cstdint>

#include "core/light/stokes.h"
#include "core/math/vec3.h"
#include "core/montecarlo/photon_rng.h"

namespace evenglow::tracer {

/// Light in a plate whose faces are planes x, y or z = const. Its Stokes vector is counted in the meridian frame: e2 =
/// s = z x h, h the horizontal direction of travel, e1 = s x k, in the plane of k and z. A reflection at a horizontal
/// face needs no change of frame, and s is the same before and after; at a side wall the frame is turned to that wall's
/// plane of incidence and back. Signs: docs/conventions.md, "Smooth faces".
///
/// I is no power but the unit that Q, U and V are counted in: what is common to the amplitudes of a face is left in, so
/// that no division is needed; `stokes` takes it out.
struct MeridianLight {
  double kx = 0.0, ky = 0.0, kz = 1.0;
  double I = 1.0, Q = 0.0, U = 0.0, V = 0.0;

  MeridianLight() = default;
  /// The power of `light` is taken as 1.
  explicit MeridianLight(const core::StokesVector& light);
  /// The light with its frame, of power 1.
  core::StokesVector stokes() const;
  /// The same where the light is counted in another frame, that of a wall.
  core::StokesVector stokes_in(const core::PolarizationFrame& frame) const {
    const double inverse = 1.0 / I;
    return {1.0, Q * inverse, U * inverse, V * inverse, frame};
  }
  /// The light of a ray in air that comes to a wall, in that wall's frame, e2 = `s`.
  void count_along(const core::Vec3& s, const core::StokesVector& light) {
    set_polarization(light);
    const double cosine = light.frame.e1.dot(s.cross(light.frame.k));
    const double sine = -light.frame.e1.dot(s);
    turn_frame(cosine * cosine - sine * sine, 2.0 * cosine * sine);
  }
  bool is_polarized() const { return Q != 0.0 || U != 0.0 || V != 0.0; }
  void forget_polarization() {
    I = 1.0;
    Q = U = V = 0.0;
  }

  const MeridianLight& meridian() const { return *this; }

  /// U + iV times re + i im.
  [[gnu::always_inline]] void turn_phase(double re, double im) {
    const double u = U * re - V * im;
    V = U * im + V * re;
    U = u;
  }
  /// The frame's axes turned: cosine and sine of twice the angle.
  [[gnu::always_inline]] void turn_frame(double cos2, double sin2) {
    const double q = Q * cos2 + U * sin2;
    U = U * cos2 - Q * sin2;
    Q = q;
  }
  /// What is left of the polarization, times `kept`.
  void depolarize(double kept) {
    Q *= kept;
    U *= kept;
    V *= kept;
  }
  /// At an ideal mirror, in a frame whose s is common to both rays.
  void mirror() {
    U = -U;
    V = -V;
  }
  /// Real amplitudes of p and s light.
  [[gnu::always_inline]] void scale_amplitudes(double p, double s) {
    set_amplitudes(p * p * (I + Q), s * s * (I - Q), p * s);
  }
  /// The same with the odds of the power that is left, drawn by a uniform number; `whole`: power 1 in the units of p^2
  /// and s^2. False: not so, and nothing is done.
  [[gnu::always_inline]] bool scales_amplitudes(double p, double s, double whole, double uniform) {
    const double power_p = p * p * (I + Q);
    const double power_s = s * s * (I - Q);
    if (uniform * 2.0 * I * whole >= power_p + power_s) return false;
    set_amplitudes(power_p, power_s, p * s);
    return true;
  }
  /// `count` total reflections, each of which turns U + iV by re + i im, in one step.
  void reflect_totally(double re, double im, std::int64_t count) {
    if (U == 0.0 && V == 0.0) return;
    double power_re = 1.0, power_im = 0.0;
    while (count != 0) {
      // Without a branch: nobody guesses the bits of the count.
      const auto taken = static_cast<double>(count % 2);
      const double factor_re = 1.0 + taken * (re - 1.0), factor_im = taken * im;
      const double product = power_re * factor_re - power_im * factor_im;
      power_im = power_re * factor_im + power_im * factor_re;
      power_re = product;
      const double r = re * re - im * im;
      im = 2.0 * re * im;
      re = r;
      count /= 2;
    }
    turn_phase(power_re, power_im);
  }

 private:
  static constexpr double kLeast = 1e-60, kMost = 1e60;

  [[gnu::always_inline]] void set_amplitudes(double power_p, double power_s, double cross) {
    I = 0.5 * (power_p + power_s);
    Q = 0.5 * (power_p - power_s);
    U *= cross;
    V *= cross;
    if (I < kLeast || I > kMost) [[unlikely]]
      rescale();
  }

  void set_polarization(const core::StokesVector& light) {
    I = 1.0;
    Q = light.Q;
    U = light.U;
    V = light.V;
  }
  void rescale() {
    const double inverse = 1.0 / I;
    I = 1.0;
    Q *= inverse;
    U *= inverse;
    V *= inverse;
  }
};

/// cos and sin of twice the angle from the meridian frame to that of the wall whose normal lies along the axis with the
/// component `kn` of k; `kt` is the other horizontal one. sign: +1 for a wall x = const, -1 for y = const. The same
/// turn leads back to the meridian frame of the ray that the wall reflects.
struct WallTurn {
  double cos2 = 1.0, sin2 = 0.0;

  [[gnu::always_inline]] WallTurn(double kn, double kt, double kz, double sign) {
    // In the plane of k and z: e1 . z > 0; in that of k and n: e1 . n > 0. Their angle has the cosine -kz kn / (sz sn)
    // and the sine sign kt / (sz sn), with (sz sn)^2 = kz^2 kn^2 + kt^2.
    const double c = kz * kn;
    const double norm = c * c + kt * kt;
    if (norm < 1e-30) return;  // normal incidence: any frame
    const double inverse = 1.0 / norm;
    cos2 = (c * c - kt * kt) * inverse;
    sin2 = -2.0 * sign * c * kt * inverse;
  }
};

/// What a smooth face of a plate does to light of one angle of incidence (core/light/fresnel.h; Born & Wolf 1.5.2 and
/// 1.5.4). With n = n1 / n2, c and t the cosines of the incident and the refracted ray: r_p = (c - n t) / (c + n t),
/// r_s = (n c - t) / (n c + t), t_p / t_s = (n c + t) / (c + n t).
struct PlateFresnel {
  bool total = false;
  double phase_re = 1.0, phase_im = 0.0;        ///< total: r_p conj(r_s), by which U + iV turns
  double cos_t = 0.0;                           ///< of the refracted ray
  double p_sum = 1.0, s_sum = 1.0;              ///< c + n t, n c + t
  double p_reflected = 0.0, s_reflected = 0.0;  ///< r_p and r_s times p_sum s_sum

  PlateFresnel() = default;
  /// From an index `n1` at cosine `c` into `n2`.
  [[gnu::always_inline]] PlateFresnel(double c, double n1, double n2) : PlateFresnel(c, n1 / n2) {}
  /// `n`: n1 / n2.
  [[gnu::always_inline]] PlateFresnel(double c, double n) {
    const double sin2_t = sin2_refracted(c, n);
    total = sin2_t >= 1.0;
    if (total) {
      const double g = std::sqrt(sin2_t - 1.0);
      // r_p = (c - i n g) / (c + i n g), r_s = (n c - i g) / (n c + i g): r_p conj(r_s) = z^2 / |z|^2.
      const double re = n * (c * c + g * g);
      const double im = c * g * (1.0 - n * n);
      const double inverse = 1.0 / (re * re + im * im);
      phase_re = (re * re - im * im) * inverse;
      phase_im = 2.0 * re * im * inverse;
      return;
    }
    cos_t = std::sqrt(1.0 - sin2_t);
    p_sum = c + n * cos_t;
    s_sum = n * c + cos_t;
    p_reflected = (c - n * cos_t) * s_sum;
    s_reflected = (n * c - cos_t) * p_sum;
  }

  /// The same condition as `total`.
  [[gnu::always_inline]] static bool is_total(double c, double n) { return sin2_refracted(c, n) >= 1.0; }

  /// Light reflected, with the odds of its own polarization; false: it is not, and has not been changed. Not for total
  /// reflection.
  template <typename Light>
  [[gnu::always_inline]] bool reflects(Light& light, core::PhotonRng& rng) const {
    return reflects(light, rng.uniform());
  }
  template <typename Light>
  [[gnu::always_inline]] bool reflects(Light& light, double uniform) const {
    const double sums = p_sum * s_sum;
    return light.scales_amplitudes(p_reflected, s_reflected, sums * sums, uniform);
  }
  /// Into the other medium, or by the way back out of it: the ratio of the amplitudes is the same.
  template <typename Light>
  [[gnu::always_inline]] void pass(Light& light) const {
    light.scale_amplitudes(s_sum, p_sum);
  }

 private:
  [[gnu::always_inline]] static double sin2_refracted(double c, double n) { return n * n * (1.0 - c * c); }
};

/// Horizontal unit vector across the ray, s = z x h; h = +x along the normal.
inline core::Vec2 across(double kx, double ky) {
  const double sin2 = kx * kx + ky * ky;
  if (sin2 < 1e-18) return {0.0, 1.0};
  const double inverse = 1.0 / std::sqrt(sin2);
  return {-ky * inverse, kx * inverse};
}

inline MeridianLight::MeridianLight(const core::StokesVector& light)
    : kx(light.frame.k.x()), ky(light.frame.k.y()), kz(light.frame.k.z()) {
  set_polarization(light);
  if (light.is_unpolarized()) return;
  const core::Vec2 s = across(kx, ky);
  const core::Vec3& e1 = light.frame.e1;
  const double cosine = (e1.x() * s.y() - e1.y() * s.x()) * kz + e1.z() * (s.x() * ky - s.y() * kx);
  const double sine = -(s.x() * e1.x() + s.y() * e1.y());
  turn_frame(cosine * cosine - sine * sine, 2.0 * cosine * sine);
}

inline core::StokesVector MeridianLight::stokes() const {
  const core::Vec2 s = across(kx, ky);
  return stokes_in({core::Vec3(kx, ky, kz), core::Vec3(s.y() * kz, -s.x() * kz, s.x() * ky - s.y() * kx)});
}

}  // namespace evenglow::tracer
