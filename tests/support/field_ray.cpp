#include "tests/support/field_ray.h"

#include <algorithm>
#include <cmath>

#include "core/base/units.h"
#include "tracer/optics/bsdf.h"

namespace evenglow::tests {

using core::Vec3;
using Complex = std::complex<double>;

FieldRay field_of(const core::StokesVector& light, core::PhotonRng& rng) {
  const Vec3 e1 = light.frame.e1;
  const Vec3 e2 = light.frame.e2();
  Complex a(1.0, 0.0), b(0.0, 0.0);
  if (light.is_unpolarized()) {
    const double angle = 2.0 * core::kPi * rng.uniform();
    a = std::cos(angle);
    b = std::sin(angle);
  } else {  // U + iV = 2 E1 conj(E2)
    a = std::sqrt(std::max(0.0, 0.5 * (1.0 + light.Q / light.I)));
    if (a.real() > 1e-6) b = std::conj(Complex(light.U, light.V) / light.I / (2.0 * a));
    if (a.real() <= 1e-6) b = 1.0;
  }
  return {light.frame.k, a * e1.cast<Complex>() + b * e2.cast<Complex>()};
}

core::StokesVector stokes_of(const FieldRay& ray) {
  const core::PolarizationFrame frame = tracer::tangential_frame(ray.k).frame;
  const Complex a = frame.e1.dot(ray.field);
  const Complex b = frame.e2().dot(ray.field);
  const Complex cross = 2.0 * a * std::conj(b);
  return {std::norm(a) + std::norm(b), std::norm(a) - std::norm(b), cross.real(), cross.imag(), frame};
}

/// Fresnel amplitudes with a complex cosine; light bends or is reflected by the odds of this field.
void meet_facet(FieldRay& ray, const Vec3& outward, double n_in, double n_out, bool& inside, core::PhotonRng& rng) {
  const double n1 = inside ? n_in : n_out;
  const double n2 = inside ? n_out : n_in;
  const Vec3 n = inside ? outward : Vec3(-outward);
  const double c1 = std::clamp(n.dot(ray.k), 0.0, 1.0);
  Vec3 s = ray.k.cross(n);
  s = s.norm() > 1e-9 ? Vec3(s.normalized()) : Vec3(ray.k.unitOrthogonal());
  const Vec3 p = s.cross(ray.k);
  const Complex Es = s.dot(ray.field);
  const Complex Ep = p.dot(ray.field);
  const double ratio = n1 / n2;
  const Complex c2 = std::sqrt(Complex(1.0 - ratio * ratio * (1.0 - c1 * c1), 0.0));
  const Complex rs = (n1 * c1 - n2 * c2) / (n1 * c1 + n2 * c2);
  const Complex rp = (n2 * c1 - n1 * c2) / (n2 * c1 + n1 * c2);
  const double total = std::norm(Es) + std::norm(Ep);
  const double reflected = (std::norm(rs * Es) + std::norm(rp * Ep)) / total;
  if (c2.real() <= 0.0 || rng.uniform() < reflected) {
    ray.k = (ray.k - 2.0 * c1 * n).normalized();
    ray.field = (rs * Es) * s.cast<Complex>() + (rp * Ep) * s.cross(ray.k).cast<Complex>();
  } else {
    const Complex ts = 2.0 * n1 * c1 / (n1 * c1 + n2 * c2);
    const Complex tp = 2.0 * n1 * c1 / (n2 * c1 + n1 * c2);
    ray.k = (ratio * ray.k + (c2.real() - ratio * c1) * n).normalized();
    ray.field = (ts * Es) * s.cast<Complex>() + (tp * Ep) * s.cross(ray.k).cast<Complex>();
    inside = !inside;
  }
  ray.field /= ray.field.norm();
}

}  // namespace evenglow::tests
