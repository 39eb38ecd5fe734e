#include "tracer/films/wave_plate.h"

#include <cmath>

#include "core/base/error.h"
#include "core/base/units.h"
#include "tracer/films/faced_body.h"

namespace evenglow::tracer {

WavePlate::WavePlate(const Spec& spec) : spec_(spec), fast_(spec.fast_axis), slow_(spec.fast_axis + 0.5 * core::kPi) {
  core::expects(spec.retardance >= 0.0 && spec.spread >= 0.0, "retardance and its spread are not negative");
  core::expects(spec.index > 1.0 && spec.index + spec.birefringence > 1.0, "the indices of a wave plate are above 1");
}

double WavePlate::retardance_factor(const TangentialFrame& frame) const {
  const double cos_c = (spec_.birefringence >= 0.0 ? slow_ : fast_).cos_psi(frame);
  const double n_o = spec_.index, n_e = spec_.index + spec_.birefringence;
  const double s2 = frame.sin_polar * frame.sin_polar;
  const double along = s2 * cos_c * cos_c / (n_o * n_o);
  const double k_o = std::sqrt(n_o * n_o - s2);
  const double k_e = std::sqrt(n_e * n_e * (1.0 - along) - (s2 - along * n_o * n_o));
  // k_e^2 - k_o^2 = (n_e^2 - n_o^2)(1 - along): no difference of near numbers.
  return (n_e + n_o) * (1.0 - along) / (k_e + k_o);
}

AxisAngle WavePlate::fast_axis_of(const TangentialFrame& frame) const {
  const FilmAxis& across_c = spec_.birefringence >= 0.0 ? fast_ : slow_;
  const AxisAngle o = pass_axis(across_c.cos_psi(frame), across_c.sin_psi(frame), frame.sin_polar, spec_.index);
  return spec_.birefringence >= 0.0 ? o : AxisAngle{-o.cos2, -o.sin2};
}

Bsdf::Specular WavePlate::matrices(const TangentialFrame& frame) const {
  const double factor = retardance_factor(frame);
  const double spread = factor * spec_.spread;
  core::MuellerMatrix plate = core::retarder(factor * spec_.retardance);
  plate.bottomRightCorner<2, 2>() *= std::exp(-0.5 * spread * spread);
  const core::MuellerMatrix body = turned(plate, fast_axis_of(frame));
  if (spec_.faces) return faced_body(body, std::abs(frame.frame.k.z()), spec_.index);
  return {body, core::MuellerMatrix::Zero()};
}

}  // namespace evenglow::tracer
