#pragma once

#include "tracer/optics/bsdf.h"

namespace evenglow::tracer {

/// A parallel sheet of index `n` in air whose body does `body` to light on one passage: both smooth faces (Fresnel, s
/// and p apart, with signs), all orders of reflection added without interference. Between tangential frames:
///
///     T = t_out B (1 - r B r B)^-1 t_in,     R = r_in + t_out B r B (1 - r B r B)^-1 t_in
///
/// (the adding method of van de Hulst, Multiple Light Scattering, 1980, with Mueller matrices). Each passage counts
/// with the same B: the body is the same seen from both sides, and its tangential count is that of the mirror image.
/// For B = a: `incoherent_sheet`. `cos_incident` in [0, 1], in air.
Bsdf::Specular faced_body(const core::MuellerMatrix& body, double cos_incident, double n);

/// The transmittance of a body (one passage at normal incidence) that gives a sheet of index `n` with both faces the
/// transmittance `total`: the root of (1 - r)^2 a / (1 - r^2 a^2) = total, r = ((n - 1) / (n + 1))^2.
/// `total` in [0, greatest_through_faces(n)].
double body_transmittance(double total, double n);
/// (1 - r) / (1 + r): what a clear sheet transmits at normal incidence.
double greatest_through_faces(double n);

}  // namespace evenglow::tracer
