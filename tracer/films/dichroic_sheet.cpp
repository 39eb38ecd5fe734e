#include "tracer/films/dichroic_sheet.h"

#include <cmath>

#include "core/base/error.h"
#include "tracer/films/faced_body.h"

namespace evenglow::tracer {
namespace {

double body_of(double total, const DichroicSheet::Spec& spec) {
  if (!spec.reflectance) return body_transmittance(total, spec.index);
  return *spec.reflectance < 1.0 ? std::min(1.0, total / (1.0 - *spec.reflectance)) : 0.0;
}

}  // namespace

DichroicSheet::DichroicSheet(const Spec& spec)
    : spec_(spec), axis_(spec.axis), pass_(body_of(spec.k1, spec)), block_(body_of(spec.k2, spec)) {
  core::expects(spec.index > 1.0, "the index of a dichroic sheet is above 1");
  core::expects(0.0 <= spec.k2 && spec.k2 <= spec.k1, "k2 of a dichroic sheet lies in [0, k1]");
  const double most = spec.reflectance ? 1.0 - *spec.reflectance : greatest_through_faces(spec.index);
  core::expects(!spec.reflectance || (*spec.reflectance >= 0.0 && *spec.reflectance <= 1.0),
                "the reflectance of a dichroic sheet lies in [0, 1]");
  core::expects(spec.k1 <= most + 1e-12, "k1 of a dichroic sheet is at most what its faces let through");
}

Bsdf::Specular DichroicSheet::matrices(const TangentialFrame& frame) const {
  const double cos_psi = axis_.cos_psi(frame), sin_psi = axis_.sin_psi(frame);
  const double s = frame.sin_polar / spec_.index;
  const double path = 1.0 / std::sqrt(1.0 - s * s);
  const double cos2_g = s * s * sin_psi * sin_psi;  // b . h = -sin psi
  const double pass = std::pow(pass_, path);
  const double block = std::pow(pass_, cos2_g * path) * std::pow(block_, (1.0 - cos2_g) * path);
  const core::MuellerMatrix body =
      turned(core::diattenuator(pass, block), pass_axis(cos_psi, sin_psi, frame.sin_polar, spec_.index));
  if (!spec_.reflectance) return faced_body(body, std::abs(frame.frame.k.z()), spec_.index);
  return {(1.0 - *spec_.reflectance) * body, *spec_.reflectance * core::MuellerMatrix::Identity()};
}

}  // namespace evenglow::tracer
