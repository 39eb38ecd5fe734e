#include "tracer/films/faced_body.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

#include "core/light/fresnel.h"

namespace evenglow::tracer {
namespace {

/// Mueller matrix of real amplitudes along p and s.
core::MuellerMatrix amplitudes(double p, double s, double power) {
  core::MuellerMatrix M = core::MuellerMatrix::Zero();
  M(0, 0) = M(1, 1) = 0.5 * (p * p + s * s) * power;
  M(0, 1) = M(1, 0) = 0.5 * (p * p - s * s) * power;
  M(2, 2) = M(3, 3) = p * s * power;
  return M;
}

/// One face between tangential frames: reflection has the amplitudes -r_p and r_s there (docs/conventions.md).
Bsdf::Specular face(double cos_incident, double n1, double n2) {
  const core::FresnelFace f = core::fresnel(cos_incident, n1, n2);
  return {amplitudes(f.t_p, f.t_s, f.transmitted_power), amplitudes(-f.r_p.real(), f.r_s.real(), 1.0)};
}

double normal_reflectance(double n) {
  const double r = (n - 1.0) / (n + 1.0);
  return r * r;
}

}  // namespace

Bsdf::Specular faced_body(const core::MuellerMatrix& body, double cos_incident, double n) {
  // At grazing the faces are opaque mirrors, and the sum over orders 0/0.
  const double c = std::max(cos_incident, 1e-9);
  const Bsdf::Specular outer = face(c, 1.0, n);
  const Bsdf::Specular inner = face(std::sqrt(1.0 - (1.0 - c * c) / (n * n)), n, 1.0);
  const core::MuellerMatrix back = inner.reflection * body;
  const core::MuellerMatrix far = body * (core::MuellerMatrix::Identity() - back * back).inverse() * outer.transmission;
  return {inner.transmission * far, outer.reflection + inner.transmission * body * inner.reflection * far};
}

double greatest_through_faces(double n) {
  const double r = normal_reflectance(n);
  return (1.0 - r) / (1.0 + r);
}

double body_transmittance(double total, double n) {
  const double r = normal_reflectance(n);
  const double t2 = (1.0 - r) * (1.0 - r);
  // The root of r^2 T a^2 + t2 a - T = 0 without cancellation.
  return std::min(1.0, 2.0 * total / (t2 + std::sqrt(t2 * t2 + 4.0 * r * r * total * total)));
}

}  // namespace evenglow::tracer
